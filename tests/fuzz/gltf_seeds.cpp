// fuzz_gltf_seeds FOLDER: writes what fuzz_gltf starts from into FOLDER/seeds, and FOLDER/dictionary.
#include <cstdio>
#include <set>

#include "core/file.hpp"
#include "hostile_scenes.hpp"

using namespace dioptre;
using namespace dioptre::test;

namespace {

// Keys and names of the format, as libFuzzer's -dict reads them.
std::string dictionary(const Json& model) {
    std::set<std::string> words;
    for (const Json::json_pointer& place : placesIn(model)) {
        if (model[place.parent_pointer()].is_object()) words.insert(Json(place.back()).dump());
        if (model[place].is_string() && model[place].get_ref<const std::string&>().size() < 40)
            words.insert(model[place].dump());
    }
    std::string text;
    for (const std::string& word : words) text += Json(word).dump() + "\n";
    return text;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: fuzz_gltf_seeds FOLDER\n", stderr);
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder / "seeds");
    writeFileAtomically(folder / "seeds/triangle.gltf", triangleGltf().dump());
    writeFileAtomically(folder / "seeds/textured.gltf", texturedGltf().dump());
    writeFileAtomically(folder / "seeds/everything.gltf", everythingGltf().dump());
    writeFileAtomically(folder / "seeds/everything.glb", asGlb(everythingGltf()));
    writeFileAtomically(folder / "dictionary", dictionary(everythingGltf()));
    return 0;
}
