#include "core/resources.hpp"

#include <string>

#include "core/error.hpp"

namespace dioptre {

namespace {

std::filesystem::path findRoot() {
    std::error_code ignored;
    auto folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    while (!folder.empty()) {
        if (std::filesystem::is_directory(folder / "shaders", ignored) &&
            std::filesystem::is_directory(folder / "config", ignored))
            return folder;
        if (folder == folder.root_path()) break;
        folder = folder.parent_path();
    }
    return DIOPTRE_RESOURCE_ROOT;
}

}  // namespace

std::filesystem::path resource(const std::filesystem::path& relative) {
    static const std::filesystem::path root = findRoot();
    auto path = root / relative;
    if (!std::filesystem::exists(path)) throw RunError(path.string() + ": not there, the installation is incomplete");
    return path;
}

}  // namespace dioptre
