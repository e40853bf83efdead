// shaders/shared/scene_types.h is read by two compilers: the GL is asked whether both see the same.
#include <cstddef>
#include <string>

#include "gl/program.hpp"
#include "gl_fixture.hpp"
#include "shaders/shared/deform_types.h"
#include "shaders/shared/scene_types.h"

namespace dioptre {
namespace {

using namespace test;

class SharedStructsGLTest : public GlTest {
  protected:
    GLint ask(const std::string& variable, GLenum property) const {
        const GLuint index = glGetProgramResourceIndex(program_.name(), GL_BUFFER_VARIABLE, variable.c_str());
        if (index == GL_INVALID_INDEX) {
            ADD_FAILURE() << variable << " is not in the program";
            return -1;
        }
        GLint value = -1;
        glGetProgramResourceiv(program_.name(), GL_BUFFER_VARIABLE, index, 1, &property, 1, nullptr, &value);
        return value;
    }
    void expectMember(const std::string& variable, std::size_t offset, std::size_t stride, GLenum type) const {
        EXPECT_EQ(ask(variable, GL_OFFSET), static_cast<GLint>(offset)) << variable;
        EXPECT_EQ(ask(variable, GL_TOP_LEVEL_ARRAY_STRIDE), static_cast<GLint>(stride)) << variable;
        EXPECT_EQ(ask(variable, GL_TYPE), static_cast<GLint>(type)) << variable;
    }
    GLint binding(const char* block) const {
        const GLuint index = glGetProgramResourceIndex(program_.name(), GL_SHADER_STORAGE_BLOCK, block);
        const GLenum property = GL_BUFFER_BINDING;
        GLint value = -1;
        if (index != GL_INVALID_INDEX)
            glGetProgramResourceiv(program_.name(), GL_SHADER_STORAGE_BLOCK, index, 1, &property, 1, nullptr, &value);
        return value;
    }

    Program program_{"scene/scene.vert.glsl", "scene/surface.frag.glsl", {"LIT", "MAPPED", "OCCLUSION"}};
};

TEST_F(SharedStructsGLTest, InstanceData) {
    using gpu::InstanceData;
    const std::size_t stride = sizeof(InstanceData);
    expectMember("instances[0].viewFromMesh", offsetof(InstanceData, viewFromMesh), stride, GL_FLOAT_MAT4);
    expectMember("instances[0].material", offsetof(InstanceData, material), stride, GL_UNSIGNED_INT_VEC4);
    EXPECT_EQ(ask("instances[0].viewFromMesh", GL_MATRIX_STRIDE), 16);
    EXPECT_EQ(ask("instances[0].viewFromMesh", GL_IS_ROW_MAJOR), 0);
    EXPECT_EQ(binding("Instances"), 0);
}

TEST_F(SharedStructsGLTest, MaterialData) {
    using gpu::MaterialData;
    const std::size_t stride = sizeof(MaterialData);
    expectMember("materials[0].baseColor", offsetof(MaterialData, baseColor), stride, GL_FLOAT_VEC4);
    expectMember("materials[0].emissive", offsetof(MaterialData, emissive), stride, GL_FLOAT_VEC4);
    expectMember("materials[0].surface", offsetof(MaterialData, surface), stride, GL_FLOAT_VEC4);
    expectMember("materials[0].light", offsetof(MaterialData, light), stride, GL_FLOAT_VEC4);
    expectMember("materials[0].uvLinear[0]", offsetof(MaterialData, uvLinear), stride, GL_FLOAT_VEC4);
    expectMember("materials[0].uvOffset[0]", offsetof(MaterialData, uvOffset), stride, GL_FLOAT_VEC4);
    for (const char* array : {"materials[0].uvLinear[0]", "materials[0].uvOffset[0]"}) {
        EXPECT_EQ(ask(array, GL_ARRAY_SIZE), gpu::kMaterialTextures) << array;
        EXPECT_EQ(ask(array, GL_ARRAY_STRIDE), static_cast<GLint>(sizeof(glm::vec4))) << array;
    }
    EXPECT_EQ(binding("Materials"), 1);
}

TEST_F(SharedStructsGLTest, LightData) {
    using gpu::LightData;
    const std::size_t stride = sizeof(LightData);
    expectMember("lights[0].position", offsetof(LightData, position), stride, GL_FLOAT_VEC4);
    expectMember("lights[0].direction", offsetof(LightData, direction), stride, GL_FLOAT_VEC4);
    expectMember("lights[0].color", offsetof(LightData, color), stride, GL_FLOAT_VEC4);
    expectMember("lights[0].cone", offsetof(LightData, cone), stride, GL_FLOAT_VEC4);
    EXPECT_EQ(binding("Lights"), 2);
}

TEST_F(SharedStructsGLTest, Deformation) {
    program_ = Program::compute("scene/deform.comp.glsl");
    using gpu::ActiveTarget;
    using gpu::InfluenceData;
    const std::size_t stride = sizeof(InfluenceData);
    expectMember("influences[0].joint", offsetof(InfluenceData, joint), stride, GL_UNSIGNED_INT);
    expectMember("influences[0].weight", offsetof(InfluenceData, weight), stride, GL_FLOAT);
    expectMember("activeTargets[0].target", offsetof(ActiveTarget, target), sizeof(ActiveTarget), GL_UNSIGNED_INT);
    expectMember("activeTargets[0].weight", offsetof(ActiveTarget, weight), sizeof(ActiveTarget), GL_FLOAT);
    GLint group[3] = {};
    glGetProgramiv(program_.name(), GL_COMPUTE_WORK_GROUP_SIZE, group);
    EXPECT_EQ(group[0], gpu::kDeformGroup);
}

}  // namespace
}  // namespace dioptre
