#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "frame/sequence.hpp"

namespace dioptre {

namespace {

// Dark by default because pictures are judged on it; light where the reader asks for it.
constexpr const char* kStyle = R"css(
:root{--ground:#15171a;--ink:#e8e6e1;--soft:#9a9790;--line:#2c2f34;--a:#f0b35a;--b:#6fb3d2}
@media (prefers-color-scheme:light){:root{--ground:#f6f4ef;--ink:#222;--soft:#6d6a63;--line:#d8d4ca;--a:#b36b00;--b:#20698c}}
body{background:var(--ground);color:var(--ink);font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:82rem;padding:0 1rem}
h1{font-weight:600;margin:0}p{color:var(--soft);margin:.3rem 0 1.2rem}
figure{margin:0;border:1px solid var(--line);border-radius:6px;overflow:hidden}
figure img{display:block;width:100%}
figcaption{padding:.4rem .7rem;font-size:13px;color:var(--soft)}figcaption b{color:var(--ink);font-weight:600}
#stage{margin-bottom:1rem}input[type=range]{width:100%;accent-color:var(--a)}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(20rem,1fr));gap:.8rem;margin-top:1.5rem}
svg{width:100%;height:auto;background:transparent}svg text{fill:var(--soft);font-size:12px}
)css";

constexpr const char* kScript = R"js(
const s=document.getElementById('at'),g=document.querySelectorAll('.grid figure'),p=document.getElementById('stage');
function show(){const f=g[s.value];p.querySelector('img').src=f.querySelector('img').src;
p.querySelector('figcaption').innerHTML=f.querySelector('figcaption').innerHTML}
s.addEventListener('input',show);g.forEach((f,i)=>f.addEventListener('click',()=>{s.value=i;show();scrollTo({top:0})}));
)js";

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

std::string distanceText(double dioptres) {
    if (dioptres <= 0.0) return "infinity";
    const double metres = 1.0 / dioptres;
    return metres < 1.0 ? fmt::format("{:.1f} cm", metres * 100.0) : fmt::format("{:.2f} m", metres);
}

/// One curve over time in its own scale; `unit` labels the top. A `limit` is drawn, too; 0: none.
std::string curve(std::span<const FrameReport> frames, double (*value)(const FrameReport&), const char* color,
                  const char* unit, int top, double limit = 0.0) {
    constexpr double kWidth = 1000.0, kHeight = 90.0;
    double most = std::max(limit, 1e-9);
    for (const FrameReport& f : frames) most = std::max(most, value(f));
    std::string points;
    const double last = std::max<double>(1.0, static_cast<double>(frames.size()) - 1.0);
    for (std::size_t i = 0; i < frames.size(); ++i)
        points += fmt::format("{:.1f},{:.1f} ", 60.0 + kWidth * static_cast<double>(i) / last,
                              top + kHeight * (1.0 - value(frames[i]) / most));
    const std::string line =
        limit > 0.0 ? fmt::format(
                          "<line x1='60' x2='1060' y1='{0:.1f}' y2='{0:.1f}' stroke='var(--ink)' "
                          "stroke-dasharray='4 4'/><text x='66' y='{1:.1f}'>budget {2:.4g} ms</text>",
                          top + kHeight * (1.0 - limit / most), top + kHeight * (1.0 - limit / most) - 4.0, limit)
                    : "";
    return line + fmt::format(
                      "<line x1='60' x2='1060' y1='{0}' y2='{0}' stroke='var(--line)'/>"
                      "<text x='0' y='{1}'>{2} {3}</text><text x='0' y='{0}'>0</text>"
                      "<polyline fill='none' stroke='var({4})' stroke-width='2' points='{5}'/>",
                      top + static_cast<int>(kHeight), top + 10,
                      most < 100.0 ? fmt::format("{:.3g}", most) : fmt::format("{:.0f}", most), unit, color, points);
}

}  // namespace

std::string sequencePage(const SequenceRequest& request, std::span<const FrameReport> frames) {
    std::string cards;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const FrameReport& f = frames[i];
        cards += fmt::format(
            "<figure><img loading='lazy' src='frame_{:04d}.png' alt='frame {}'><figcaption>{:.2f} s &middot; focus "
            "<b>{}</b> ({:.2f} D) &middot; pupil {:.1f} mm &middot; {} &middot; <b>{:.1f} "
            "ms</b>{}</figcaption></figure>\n",
            i, i, f.time, distanceText(f.lens.lens.focus.value), f.lens.lens.focus.value,
            f.lens.apertureDiameter.value * 1e3, escaped(planText(f.plan)), f.milliseconds,
            f.decision ? fmt::format(" of {:.4g} ms", f.budgetMs) : "");
    }
    const std::string plots =
        curve(
            frames, [](const FrameReport& f) { return std::max(0.0, f.lens.lens.focus.value); }, "--a", "D", 10) +
        curve(
            frames, [](const FrameReport& f) { return f.milliseconds; }, "--b", "ms", 130,
            frames.front().decision ? request.budgetMs : 0.0);
    return fmt::format(
        "<!doctype html><html lang='en'><meta charset='utf-8'><meta name='viewport' content='width=device-width'>"
        "<title>Dioptre: {0}</title><style>{1}</style>\n<h1>{0}</h1>"
        "<p>{2} frames, {3:g} per second. Above: focus in dioptres; below: milliseconds per frame.</p>\n"
        "<figure id='stage'><img src='frame_0000.png' alt='chosen frame'><figcaption></figcaption></figure>"
        "<input id='at' type='range' min='0' max='{4}' value='0' aria-label='frame'>\n"
        "<svg viewBox='0 0 1070 230' role='img' aria-label='focus and time of each frame'>{5}</svg>\n"
        "<div class='grid'>\n{6}</div><script>{7}show();</script></html>\n",
        escaped(request.title), kStyle, frames.size(), request.fps, frames.empty() ? 0 : frames.size() - 1, plots,
        cards, kScript);
}

}  // namespace dioptre
