// One headless context for all GL tests of a process, and the fixture that fails a test which leaves a GL error behind.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "gl/context.hpp"

namespace dioptre::test {

/// What the GL complained about since the list was last cleared.
inline std::vector<std::string>& glComplaints() {
    static std::vector<std::string> complaints;
    return complaints;
}

/// DIOPTRE_TEST_CONTEXT: auto (default), osmesa, egl.
class GlEnvironment : public ::testing::Environment {
  public:
    void SetUp() override {
        const char* kind = std::getenv("DIOPTRE_TEST_CONTEXT");
        try {
            context_ = createHeadlessContext(kind ? kind : "auto");
        } catch (const std::exception& error) {
            FAIL() << "no GL to test with: " << error.what();
        }
        glDebugMessageCallback(complain, nullptr);
    }
    void TearDown() override { context_.reset(); }

  private:
    static void GLAPIENTRY complain(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text, const void*) {
        if (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) glComplaints().emplace_back(text);
    }

    std::unique_ptr<Context> context_;
};

inline ::testing::Environment* const kGlEnvironment = ::testing::AddGlobalTestEnvironment(new GlEnvironment);

class GlTest : public ::testing::Test {
  protected:
    void SetUp() override {
        while (glGetError() != GL_NO_ERROR) {
        }
        glComplaints().clear();
    }
    void TearDown() override {
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
        EXPECT_TRUE(glComplaints().empty())
            << "the GL complained " << glComplaints().size() << " times, first: " << glComplaints().front();
    }
};

}  // namespace dioptre::test
