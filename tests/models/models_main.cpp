// dioptre_models_tests DIR: the models in DIR/gltf-asset-generator and DIR/*.glb (scripts/test --models DIR).
#include <cstdio>

#include "models_common.hpp"

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (argc != 2) {
        std::fputs("dioptre_models_tests: give the folder of the models\n", stderr);
        return 2;
    }
    dioptre::test::modelsFolder() = argv[1];
    if (!std::filesystem::is_directory(dioptre::test::assetGenerator())) {
        std::fprintf(stderr, "dioptre_models_tests: %s: no such folder\n", dioptre::test::assetGenerator().c_str());
        return 2;
    }
    return RUN_ALL_TESTS();
}
