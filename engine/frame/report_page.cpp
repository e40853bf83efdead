#include "frame/report_page.hpp"

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/resources.hpp"

namespace dioptre {

namespace {

constexpr std::size_t kLargestPart = 1u << 20;
constexpr std::string_view kData = "\"@DATA@\"";

std::string part(const std::string& name) {
    return readFile(resource("assets/pages/" + name), kLargestPart);
}

std::size_t placeOf(const std::string& page, std::string_view what, std::string_view name) {
    const auto place = page.find(what);
    if (place == std::string::npos)
        throw RunError("assets/pages/" + std::string(name) + ".html: " + std::string(what) +
                       " is missing, the installation is incomplete");
    return place;
}

}  // namespace

ReportPage::ReportPage(std::string_view name) : page_(part(std::string(name) + ".html")) {
    constexpr std::string_view kStyle = "/*@STYLE@*/\n", kScript = "/*@SCRIPT@*/\n";
    page_.replace(placeOf(page_, kStyle, name), kStyle.size(), part("common.css"));
    page_.replace(placeOf(page_, kScript, name), kScript.size(), part("common.js"));
    place_ = placeOf(page_, kData, name);
}

std::string ReportPage::with(std::string json) const {
    // A script ends at "</", wherever it stands; "<\/" is the same text to JSON.
    for (std::size_t at = 0; (at = json.find("</", at)) != std::string::npos; at += 3) json.replace(at, 2, "<\\/");
    std::string page = page_;
    return page.replace(place_, kData.size(), json);
}

}  // namespace dioptre
