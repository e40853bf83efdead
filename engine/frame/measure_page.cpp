#include "frame/measure_page.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "frame/report_page.hpp"

namespace dioptre {

namespace {

using Json = nlohmann::ordered_json;

/// Each technique's row that is closest to the reference.
std::vector<const MeasuredRow*> bestRows(const Measurements& all, const MeasuredView& view) {
    std::vector<const MeasuredRow*> best;
    for (const MeasuredRow& row : all.rows) {
        if (row.view != view.key) continue;
        const auto same =
            std::find_if(best.begin(), best.end(), [&](const MeasuredRow* b) { return b->technique == row.technique; });
        if (same == best.end())
            best.push_back(&row);
        else if (row.error.ssim > (*same)->error.ssim)
            *same = &row;
    }
    return best;
}

/// Paper-like blurs tell most, small ones least.
std::vector<const MeasuredView*> inOrderOfInterest(const Measurements& all) {
    std::vector<const MeasuredView*> views;
    for (const char* blur : {"paper", "strong", "small"})
        for (const char* focus : {"near", "far"})
            for (const MeasuredView& v : all.views)
                if (v.blur == blur && v.focus == focus) views.push_back(&v);
    return views;
}

/// Pictures by key, {"picture": ..., "flip": ...}, as many as fit.
Json picturesWithin(const Measurements& all, const PictureFolder& pictures, std::size_t mostBytes) {
    Json found = Json::object();
    std::size_t bytes = 0;
    for (const MeasuredView* view : inOrderOfInterest(all)) {
        Json mine = Json::object();
        std::size_t size = 0;
        const auto put = [&](const std::string& key, bool errors) {
            const std::string picture = pictures.dataUri(key, ""), flip = errors ? pictures.dataUri(key, ".flip") : "";
            if (picture.empty()) return;
            mine[key] = {{"picture", picture}, {"flip", flip}};
            size += picture.size() + flip.size();
        };
        put(view->key, false);
        for (const MeasuredRow* row : bestRows(all, *view)) put(view->key + "." + row->key(), true);
        if (bytes + size > mostBytes) continue;
        bytes += size;
        found.update(mine);
    }
    return found;
}

}  // namespace

std::string measurePage(const Measurements& all, const PictureFolder& pictures, std::size_t mostBytes) {
    const ReportPage page("measure");
    Json data = Json::parse(measurementsJson(all));
    Json thumbs = Json::object();
    std::size_t bytes = page.bytes() + data.dump().size();
    for (const MeasuredRow& row : all.rows) {
        const std::string key = row.view + "." + row.key(), thumb = pictures.dataUri(key, ".thumb");
        if (!thumb.empty()) thumbs[key] = thumb;
        bytes += thumb.size();
    }
    data["thumbs"] = std::move(thumbs);
    data["pictures"] = picturesWithin(all, pictures, mostBytes > bytes ? mostBytes - bytes : 0);
    return page.with(data.dump(-1, ' ', true));
}

}  // namespace dioptre
