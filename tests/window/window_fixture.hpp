// A folder with scenes, and a display: the tests run under app/with_display.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "app/program.hpp"
#include "viewer_driver.hpp"

namespace dioptre::test {

class WindowTest : public ProgramTest {
  protected:
    void SetUp() override {
        if (!std::getenv("DISPLAY")) GTEST_SKIP() << "no display: run it by tests/app/with_display";
        before_ = std::filesystem::current_path();
        std::filesystem::current_path(folder);
        ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
    }
    void TearDown() override {
        if (!before_.empty()) std::filesystem::current_path(before_);
    }

  private:
    std::filesystem::path before_;
};

}  // namespace dioptre::test
