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
    GLint ask(const std::string& variable, GLenum property, GLenum interface = GL_BUFFER_VARIABLE) const {
        const GLuint index = glGetProgramResourceIndex(program_.name(), interface, variable.c_str());
        if (index == GL_INVALID_INDEX) {
            ADD_FAILURE() << variable << " is not in the program";
            return -1;
        }
        GLint value = -1;
        glGetProgramResourceiv(program_.name(), interface, index, 1, &property, 1, nullptr, &value);
        return value;
    }
    void expectMember(const std::string& variable, std::size_t offset, std::size_t stride, GLenum type) const {
        EXPECT_EQ(ask(variable, GL_OFFSET), static_cast<GLint>(offset)) << variable;
        EXPECT_EQ(ask(variable, GL_TOP_LEVEL_ARRAY_STRIDE), static_cast<GLint>(stride)) << variable;
        EXPECT_EQ(ask(variable, GL_TYPE), static_cast<GLint>(type)) << variable;
    }
    /// Of a uniform block.
    void expectUniform(const std::string& variable, std::size_t offset) const {
        EXPECT_EQ(ask(variable, GL_OFFSET, GL_UNIFORM), static_cast<GLint>(offset)) << variable;
        EXPECT_EQ(ask(variable, GL_TYPE, GL_UNIFORM), static_cast<GLint>(GL_FLOAT_VEC4)) << variable;
    }
    GLint binding(const char* block, GLenum interface = GL_SHADER_STORAGE_BLOCK) const {
        const GLuint index = glGetProgramResourceIndex(program_.name(), interface, block);
        const GLenum property = GL_BUFFER_BINDING;
        GLint value = -1;
        if (index != GL_INVALID_INDEX)
            glGetProgramResourceiv(program_.name(), interface, index, 1, &property, 1, nullptr, &value);
        return value;
    }

    Program program_{"scene/scene.vert.glsl", "scene/surface.frag.glsl", {"LIT", "MAPPED", "OCCLUSION"}};
};

TEST_F(SharedStructsGLTest, InstanceTransforms) {
    EXPECT_EQ(ask("viewFromMesh", GL_LOCATION, GL_PROGRAM_INPUT), 4);
    EXPECT_EQ(ask("viewFromMesh", GL_TYPE, GL_PROGRAM_INPUT), static_cast<GLint>(GL_FLOAT_MAT4));
}

TEST_F(SharedStructsGLTest, MaterialData) {
    using gpu::MaterialData;
    expectUniform("material.baseColor", offsetof(MaterialData, baseColor));
    expectUniform("material.emissive", offsetof(MaterialData, emissive));
    expectUniform("material.surface", offsetof(MaterialData, surface));
    expectUniform("material.light", offsetof(MaterialData, light));
    expectUniform("material.uvLinear[0]", offsetof(MaterialData, uvLinear));
    expectUniform("material.uvOffset[0]", offsetof(MaterialData, uvOffset));
    for (const char* array : {"material.uvLinear[0]", "material.uvOffset[0]"}) {
        EXPECT_EQ(ask(array, GL_ARRAY_SIZE, GL_UNIFORM), gpu::kMaterialTextures) << array;
        EXPECT_EQ(ask(array, GL_ARRAY_STRIDE, GL_UNIFORM), static_cast<GLint>(sizeof(glm::vec4))) << array;
    }
    EXPECT_EQ(binding("Material", GL_UNIFORM_BLOCK), 0);
    EXPECT_EQ(ask("Material", GL_BUFFER_DATA_SIZE, GL_UNIFORM_BLOCK), static_cast<GLint>(sizeof(MaterialData)));
    EXPECT_EQ(ask("material.unused[0]", GL_OFFSET, GL_UNIFORM), static_cast<GLint>(offsetof(MaterialData, unused)));
}

TEST_F(SharedStructsGLTest, LightData) {
    using gpu::LightData;
    const std::size_t stride = sizeof(LightData);
    expectMember("lights[0].position", offsetof(LightData, position), stride, GL_FLOAT_VEC4);
    expectMember("lights[0].direction", offsetof(LightData, direction), stride, GL_FLOAT_VEC4);
    expectMember("lights[0].color", offsetof(LightData, color), stride, GL_FLOAT_VEC4);
    expectMember("lights[0].cone", offsetof(LightData, cone), stride, GL_FLOAT_VEC4);
    EXPECT_EQ(binding("Lights"), 0);
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
