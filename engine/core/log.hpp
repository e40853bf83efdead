// Messages for people, to stderr (pictures and tables go to files, answers to stdout).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dioptre {

void logInfo(std::string_view message);
void logWarning(std::string_view message);  // "warning: ..."
void logError(std::string_view message);    // "error: ..."

/// "LABEL 12/64 NOTE": rewritten in place where stderr is a terminal, otherwise one line per tenth of the way. Finishes
/// its line when it goes away. One at a time.
class ProgressLine {
  public:
    ProgressLine(std::string label, std::size_t total);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void update(std::size_t done, std::string_view note = {});

  private:
    std::string label_;
    std::size_t total_;
    std::size_t shownTenths_ = 0;
    bool terminal_;
};

}  // namespace dioptre
