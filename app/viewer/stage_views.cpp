#include "viewer/stage_views.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace dioptre {

namespace {

constexpr int kWidth = 192;  // pixels
constexpr int kColumns = 3;

struct NamedStage {
    ShowChoice stage;
    const char *name, *meaning;
    std::optional<TechniqueChoice> only;  // none: every technique has it
};
const NamedStage kStages[] = {
    {ShowChoice::none, "picture", "the picture itself", {}},
    {ShowChoice::vergence, "vergence", "depth: bright is near, black is infinity", {}},
    {ShowChoice::coc, "coc", "circle of confusion: red in front of focus, blue behind", {}},
    {ShowChoice::dob, "dob", "degree of blur, whatever its side", {}},
    {ShowChoice::don, "don", "how much blurred foreground lies nearby", TechniqueChoice::mipmap},
    {ShowChoice::level, "level", "which levels of the picture pyramid are read", TechniqueChoice::mipmap},
    {ShowChoice::lod, "lod", "which levels of detail are drawn", TechniqueChoice::accumulate}};

const NamedStage& named(const ShowStage& stage) {
    return *std::find_if(std::begin(kStages), std::end(kStages),
                         [&](const NamedStage& candidate) { return candidate.stage == stage.stage; });
}

}  // namespace

void StageViews::prepare(TechniqueChoice technique, int height) {
    if (choice_ != technique) {
        technique_ = makeTechnique(technique);
        choice_ = technique;
        stages_.clear();
    }
    if (!stages_.empty() && stages_.front().picture.height() == height) return;
    stages_.clear();
    next_ = fresh_ = 0;
    for (const NamedStage& stage : kStages) {
        if (stage.only && stage.only != technique) continue;
        Small& small = stages_.emplace_back();
        small.stage = {stage.stage, 0};
        small.picture = Texture({GL_RGBA8, kWidth, height, 1, 0}, "stage in the panel");
        small.picture.setLinear(false);
        const Framebuffer::Attachment color[] = {{&small.picture, 0}};
        small.target = Framebuffer(color, nullptr, "stage in the panel");
    }
    if (!encode_.program()) encode_ = FullscreenPass("present/compose.frag.glsl", {"MONO", "ENCODE"});
}

void StageViews::drawNext(const GpuScene& scene, const View& head, const Lens& lens, const Plan& plan,
                          double exposure) {
    View view = head;
    view.width = kWidth;
    view.height = std::max(1, kWidth * head.height / head.width);
    prepare(plan.technique, view.height);
    Small& small = stages_[next_];
    PassLog unread;
    EyeFrame frame{scene, view, lens, static_cast<float>(std::exp2(exposure)), 0, small.stage, unread};
    apply(plan, frame);
    // A few points of the lens are enough for a thumbnail.
    constexpr int kSamples = 8;
    frame.samples = std::min(frame.samples, kSamples);
    technique_->draw(frame).bind(0);
    small.target.bind();
    const Program& program = encode_.program();
    program.set("origin", glm::vec2(0.0f));
    const glm::vec2 size(small.target.width(), small.target.height());
    program.set("size", size);
    program.set("eyeSize", size);
    encode_.draw();
    next_ = (next_ + 1) % stages_.size();
    ++fresh_;
}

std::optional<ShowStage> StageViews::draw(const ShowStage& current) {
    shown_ = true;
    std::optional<ShowStage> clicked;
    if (stages_.empty() || !ImGui::BeginTable("stages", kColumns)) return clicked;
    for (const Small& small : stages_) {
        ImGui::TableNextColumn();
        const float width = ImGui::GetContentRegionAvail().x;
        const float height = width * static_cast<float>(small.picture.height()) / kWidth;
        const NamedStage& stage = named(small.stage);
        ImGui::PushID(stage.name);
        // ImGui's textures are names in pointers; GL's first row is the lowest.
        const auto id = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(small.picture.name()));
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.0f, 0.0f));
        if (ImGui::ImageButton(id, {width, height}, {0.0f, 1.0f}, {1.0f, 0.0f})) clicked = small.stage;
        ImGui::PopStyleVar();
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s; a click shows it large", stage.meaning);
        ImGui::PopID();
        if (small.stage == current)
            ImGui::TextUnformatted(stage.name);
        else
            ImGui::TextDisabled("%s", stage.name);
    }
    ImGui::EndTable();
    return clicked;
}

}  // namespace dioptre
