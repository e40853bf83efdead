// Runs the program as a user does, in a folder of its own with a small scene in it.
#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace dioptre::test {

struct Outcome {
    int status = -1;  // exit code; 128 + signal where one ended it
    std::string out, err;
    double seconds = 0.0;  // of the processor
    long kilobytes = 0;    // of memory, at most
};

inline std::string textOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

/// What a user must get for wrong usage or bad input: exit code 2, nothing on stdout, one line on stderr.
inline void expectRefused(const Outcome& outcome, const std::vector<std::string>& fragments) {
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(linesOf(outcome.err).size(), 1u) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("error: ")) << outcome.err;
    for (const std::string& fragment : fragments) EXPECT_THAT(outcome.err, testing::HasSubstr(fragment));
}

class ProgramTest : public testing::Test {
  protected:
    ProgramTest() {
        std::string name = (std::filesystem::temp_directory_path() / "dioptre-app-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        folder = name;
        writeScene();
    }
    ~ProgramTest() override {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }

    /// Runs another program, or dioptre, with `folder` as the current one.
    Outcome runProgram(const std::string& program, const std::vector<std::string>& arguments) const {
        const std::filesystem::path out = folder / ".stdout", err = folder / ".stderr";
        const pid_t child = ::fork();
        if (child == 0) exec(program, arguments, out, err);
        int status = 0;
        rusage usage{};
        if (child < 0 || ::wait4(child, &status, 0, &usage) != child) throw std::runtime_error("no child process");
        Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), textOf(out), textOf(err)};
        for (const timeval& t : {usage.ru_utime, usage.ru_stime})
            outcome.seconds += static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
        outcome.kilobytes = usage.ru_maxrss;
        std::filesystem::remove(out);
        std::filesystem::remove(err);
        return outcome;
    }
    Outcome run(const std::vector<std::string>& arguments) const { return runProgram(DIOPTRE_PROGRAM, arguments); }

    /// The same, of the small scene, which must work.
    /// The technique is mipmap where the options say nothing about it.
    Outcome draw(std::vector<std::string> options) const {
        const bool said = std::any_of(options.begin(), options.end(), [](const std::string& option) {
            return option == "--technique" || option == "--show" || option == "--config";
        });
        if (!said) options.insert(options.begin(), {"--technique", "mipmap"});
        options.insert(options.begin(), {"render", "scene.gltf", "--size", "40x30"});
        Outcome outcome = run(options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome;
    }

    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder / name, std::ios::binary) << bytes;
    }
    std::string read(const std::string& name) const { return textOf(folder / name); }
    bool there(const std::string& name) const { return std::filesystem::exists(folder / name); }

    /// Names in the folder but for the scene's.
    std::vector<std::string> leftBehind() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (!entry.path().filename().string().starts_with("scene.")) names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

    std::filesystem::path folder;
    rlim_t fileSizeLimit = RLIM_INFINITY;  // bytes; what a full disk looks like to the program
    // With the system's EGL or GLX: under LeakSanitizer their drivers leak, and are unloaded before they could be
    // named.
    bool leaksAllowed = false;

  private:
    [[noreturn]] void exec(const std::string& program, const std::vector<std::string>& arguments,
                           const std::filesystem::path& out, const std::filesystem::path& err) const {
        std::vector<char*> argv;
        argv.push_back(const_cast<char*>(program.c_str()));
        for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
        ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
        if (fileSizeLimit != RLIM_INFINITY) {
            const rlimit limit{fileSizeLimit, fileSizeLimit};
            ::setrlimit(RLIMIT_FSIZE, &limit);
            ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // it would be cut off, too
        }
        if (leaksAllowed) ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
        if (::chdir(folder.c_str()) == 0) ::execvp(program.c_str(), argv.data());
        ::_exit(127);
    }

    /// A red square 0.4 m before the camera, left of the middle, and a grey wall 4 m away; a camera at the origin.
    void writeScene() const {
        const std::vector<float> corners = {-0.2f, -0.1f, -0.4f, 0, -0.1f, -0.4f, 0, 0.1f, -0.4f, -0.2f, 0.1f, -0.4f,
                                            -9,    -9,    -4,    9, -9,    -4,    9, 9,    -4,    -9,    9,    -4};
        const std::vector<unsigned short> indices = {0, 1, 2, 0, 2, 3};
        std::string bytes(reinterpret_cast<const char*>(corners.data()), corners.size() * sizeof(float));
        bytes.append(reinterpret_cast<const char*>(indices.data()), indices.size() * sizeof(unsigned short));
        write("scene.bin", bytes);
        write("scene.gltf", R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_unlit"], "scene": 0,
"scenes": [{"nodes": [0, 1]}],
"nodes": [{"mesh": 0}, {"camera": 0, "name": "eye"}],
"cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.05}}],
"materials": [
    {"extensions": {"KHR_materials_unlit": {}}, "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.1, 0.1, 1]}},
    {"extensions": {"KHR_materials_unlit": {}}, "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1]}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 2, "material": 0},
                           {"attributes": {"POSITION": 1}, "indices": 2, "material": 1}]}],
"accessors": [
    {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4, "min": [-0.2, -0.1, -0.4], "max": [0, 0.1, -0.4]},
    {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "type": "VEC3", "count": 4,
     "min": [-9, -9, -4], "max": [9, 9, -4]},
    {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 6}],
"bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 12}],
"buffers": [{"uri": "scene.bin", "byteLength": 108}]})");
    }
};

}  // namespace dioptre::test
