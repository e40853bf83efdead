// What a run is measured on.
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include "frame/measure.hpp"
#include "gl/context.hpp"

namespace dioptre {

namespace {

std::string cpuName() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name"))
            if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
    return "unknown";
}

std::string systemName() {
    utsname names{};
    return ::uname(&names) == 0 ? fmt::format("{} {} {}", names.sysname, names.release, names.machine) : "unknown";
}

std::string dateNow() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    char text[32] = {};
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

}  // namespace

MeasuredWith measuredHere() {
    MeasuredWith with;
    const RendererInfo gl = rendererInfo();
    with.renderer = gl.renderer;
    with.version = gl.version;
    with.cpu = cpuName();
    with.cores = static_cast<int>(std::thread::hardware_concurrency());
    with.memoryBytes = static_cast<std::uint64_t>(std::max(0L, ::sysconf(_SC_PHYS_PAGES))) *
                       static_cast<std::uint64_t>(std::max(0L, ::sysconf(_SC_PAGESIZE)));
    with.system = systemName();
    with.date = dateNow();
    if (double load = 0.0; ::getloadavg(&load, 1) == 1) with.load = load;
    return with;
}

}  // namespace dioptre
