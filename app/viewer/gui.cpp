#include "viewer/gui.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "backends/imgui_impl_glfw.h"
#include "backends/imgui_impl_opengl3.h"

namespace dioptre {

namespace {

constexpr float kFontPixels = 15.0f;         // at a scale of 1
constexpr float kBuiltInFontPixels = 13.0f;  // what it was drawn for

// A font that most systems have; without it, ImGui's own.
constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                  "/usr/share/fonts/TTF/DejaVuSans.ttf"};

void setStyle(float scale) {
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 0.0f;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = 3.0f;
    style.WindowBorderSize = 0.0f;
    style.ItemSpacing = {6.0f, 4.0f};
    style.Colors[ImGuiCol_WindowBg] = {0.09f, 0.095f, 0.11f, 0.96f};
    style.Colors[ImGuiCol_Header] = {0.20f, 0.23f, 0.29f, 1.0f};
    style.Colors[ImGuiCol_HeaderHovered] = {0.26f, 0.31f, 0.40f, 1.0f};
    style.Colors[ImGuiCol_HeaderActive] = {0.30f, 0.37f, 0.48f, 1.0f};
    style.Colors[ImGuiCol_FrameBg] = {0.16f, 0.17f, 0.20f, 1.0f};
    style.Colors[ImGuiCol_FrameBgHovered] = {0.22f, 0.24f, 0.29f, 1.0f};
    style.Colors[ImGuiCol_Button] = {0.21f, 0.26f, 0.34f, 1.0f};
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

}  // namespace

Gui::Gui(GLFWwindow* window) : window_(window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // nothing is left in the folder that it runs in
    ImGui_ImplGlfw_InitForOpenGL(window, false);
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

Gui::~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Gui::begin(double scale) {
    setScale(scale);
    feedKeys();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    feedMouse();
    ImGui::NewFrame();
}

void Gui::end() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Gui::takesKeys() const {
    return ImGui::GetIO().WantTextInput || ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
}

/// ImGui looks at keys once a frame: of each key one change a frame, so that none is lost where frames are slow.
void Gui::feedKeys() {
    std::vector<KeyEvent> later;
    std::vector<int> changed;
    for (const KeyEvent& event : keys_) {
        if (std::find(changed.begin(), changed.end(), event.key) != changed.end()) {
            later.push_back(event);
            continue;
        }
        ImGui_ImplGlfw_KeyCallback(window_, event.key, event.scancode, event.action, event.mods);
        changed.push_back(event.key);
    }
    keys_ = std::move(later);
}

/// ImGui looks at the mouse once a frame: one press or release a frame, with the pointer where it was then, and before a
/// release a frame there with the button still down. So a press is of what was there, and a drag goes all of its way,
/// however much comes within a slow frame.
void Gui::feedMouse() {
    static_assert(std::size(decltype(held_){}) == ImGuiMouseButton_COUNT);
    ImGuiIO& io = ImGui::GetIO();
    if (!buttons_.empty()) {
        const ButtonEvent event = buttons_.front();
        if (event.down || event.pointer == pointer_) {
            if (event.button < ImGuiMouseButton_COUNT) held_[event.button] = event.down;
            buttons_.erase(buttons_.begin());
        }
        io.MousePos = {static_cast<float>(event.pointer.x), static_cast<float>(event.pointer.y)};
        pointer_ = event.pointer;
    } else {
        pointer_ = {io.MousePos.x, io.MousePos.y};
    }
    std::copy(std::begin(held_), std::end(held_), io.MouseDown);
}

void Gui::setScale(double scale) {
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(window_, &x, &y);
    int width = 0, pixels = 0, height = 0;
    glfwGetWindowSize(window_, &width, &height);
    glfwGetFramebufferSize(window_, &pixels, &height);
    // Where the window's own coordinates are scaled already, a desktop's scale is in them.
    if (width > 0 && pixels > 0) scale *= static_cast<double>(x) * width / pixels;
    if (scale == scale_) return;
    scale_ = scale;
    setStyle(static_cast<float>(scale));
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    const auto pixelSize = static_cast<float>(std::round(static_cast<double>(kFontPixels) * scale));
    const auto file = std::find_if(std::begin(kFonts), std::end(kFonts), [](const char* name) {
        std::error_code unreadable;
        return std::filesystem::exists(name, unreadable);
    });
    if (file != std::end(kFonts)) {
        fonts.AddFontFromFileTTF(*file, pixelSize);
    } else {
        ImFontConfig config;
        config.SizePixels = kBuiltInFontPixels * static_cast<float>(scale);
        fonts.AddFontDefault(&config);
    }
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

}  // namespace dioptre
