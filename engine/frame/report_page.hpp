// Pages that show a run: one file each, with data, style and script in it, and no network.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dioptre {

/// assets/pages/NAME.html, where "@DATA@" with its quotes becomes the data, /*@STYLE@*/ common.css and /*@SCRIPT@*/
/// common.js.
class ReportPage {
  public:
    /// RunError where a file or a place is missing: the installation is incomplete.
    explicit ReportPage(std::string_view name);

    std::size_t bytes() const { return page_.size(); }  // without data
    /// `json`: whatever stands in it, it ends no script.
    std::string with(std::string json) const;

  private:
    std::string page_;
    std::size_t place_ = 0;  // of the data
};

}  // namespace dioptre
