#include "scene/lod.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "scene/builtin.hpp"
#include "scene/lod_cache.hpp"
#include "scene/shared_vertices.hpp"

namespace dioptre {

namespace fs = std::filesystem;

// Of threads in the background: a tenth of what a window's thread gets.
static constexpr int kBackgroundNice = 10;

bool hasLods(const Primitive& primitive) {
    return primitive.triangleCount() > kFewestTriangles && !primitive.deformation;
}

fs::path lodFolder() {
    const fs::path folder = cacheFolder();
    return folder.empty() ? folder : folder / "lods";
}

class LodBuilder::State {
  public:
    State(const Scene& scene, const LodOptions& options);
    ~State();

    std::vector<BuiltLevel> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(ready_, {});
    }
    bool finished() const {
        const std::lock_guard lock(mutex_);
        return running_ == 0;
    }
    void wait() const {
        std::unique_lock lock(mutex_);
        allDone_.wait(lock, [&] { return running_ == 0; });
    }
    double progress() const {
        const std::lock_guard lock(mutex_);
        return running_ == 0 ? 1.0 : static_cast<double>(trianglesDone_) / static_cast<double>(triangles_);
    }

  private:
    struct Job {
        std::size_t mesh, primitive;
        const Primitive* source;
        std::size_t counted = 0;  // of its triangles, in trianglesDone_
    };
    /// Of equal primitives: one thread makes it, all get it.
    struct Chain {
        std::vector<LodLevel> levels;
        std::vector<Job*> users;
        bool cached = false, complete = false;
    };

    void work();
    void build(Job& job);
    Chain* claim(const std::string& key, Job& job);
    void hand(Chain& chain, LodLevel level);
    void complete(Chain& chain);
    void give(Job& job, std::size_t level, const LodLevel& data, bool cached);
    void count(Job& job, std::size_t triangles);
    bool readInto(Chain& chain, const fs::path& file, const Primitive& primitive);
    void write(const fs::path& file, const std::string& bytes);

    const Scene& scene_;
    const fs::path folder_;
    std::vector<Job> jobs_;
    std::vector<std::vector<std::vector<std::uint8_t>>> shared_;  // by mesh, primitive, vertex
    std::vector<std::once_flag> sharedOnce_;                      // by mesh
    std::size_t triangles_ = 0;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> stop_{false}, unwritable_{false}, broken_{false};

    mutable std::mutex mutex_;  // of what follows
    std::mutex writing_;
    mutable std::condition_variable allDone_;
    std::map<std::string, Chain> chains_;
    std::vector<BuiltLevel> ready_;
    std::size_t trianglesDone_ = 0, running_ = 0;
    std::vector<std::thread> threads_;
};

LodBuilder::State::State(const Scene& scene, const LodOptions& options)
    : scene_(scene), folder_(options.folder), shared_(scene.meshes.size()), sharedOnce_(scene.meshes.size()) {
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const auto& primitives = scene.meshes[m].primitives;
        for (std::size_t p = 0; p < primitives.size(); ++p)
            if (hasLods(primitives[p])) jobs_.push_back({m, p, &primitives[p]});
    }
    std::stable_sort(jobs_.begin(), jobs_.end(),
                     [](const Job& a, const Job& b) { return a.source->triangleCount() > b.source->triangleCount(); });
    for (const Job& job : jobs_) triangles_ += job.source->triangleCount();
    const std::size_t wanted =
        options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
    const std::size_t count = std::min(wanted, jobs_.size());
    running_ = count;
    threads_.reserve(count);
    try {
        for (std::size_t t = 0; t < count; ++t)
            threads_.emplace_back([this, background = options.background] {
                // Linux: of this thread alone
                if (background) ::setpriority(PRIO_PROCESS, 0, kBackgroundNice);
                work();
            });
    } catch (const std::system_error&) {
        // As many as there are do it, too.
        const std::lock_guard lock(mutex_);
        running_ -= count - threads_.size();
        if (threads_.empty()) throw;
    }
}

LodBuilder::State::~State() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
}

void LodBuilder::State::work() {
    for (std::size_t i = next_++; i < jobs_.size() && !stop_; i = next_++) {
        try {
            build(jobs_[i]);
        } catch (const std::exception& failure) {
            logWarning(fmt::format("{}: {}; it has no levels of detail beyond those that are made",
                                   quote(scene_.meshes[jobs_[i].mesh].name), failure.what()));
        }
    }
    const std::lock_guard lock(mutex_);
    if (--running_ > 0) return;
    chains_.clear();
    allDone_.notify_all();
}

void LodBuilder::State::build(Job& job) {
    const Primitive& primitive = *job.source;
    std::call_once(sharedOnce_[job.mesh],
                   [&] { shared_[job.mesh] = sharedVertices(scene_.meshes[job.mesh], [&] { return stop_.load(); }); });
    const std::span<const std::uint8_t> fixed = shared_[job.mesh][job.primitive];
    const std::string key = lodKey(primitive, fixed);
    Chain* chain = claim(key, job);
    if (!chain) return;
    const fs::path file = folder_.empty() ? fs::path() : folder_ / (key + ".lod");
    if (file.empty() || !readInto(*chain, file, primitive)) {
        simplify(
            {primitive, fixed, [&](LodLevel level) { hand(*chain, std::move(level)); }, [&] { return stop_.load(); }});
        if (stop_) return;
        if (!file.empty() && !unwritable_) write(file, lodBytes(primitive, chain->levels));
    }
    complete(*chain);
}

/// None where another job has the same content: this one gets what that has, now and later.
LodBuilder::State::Chain* LodBuilder::State::claim(const std::string& key, Job& job) {
    const std::lock_guard lock(mutex_);
    const auto [at, isNew] = chains_.try_emplace(key);
    Chain& chain = at->second;
    chain.users.push_back(&job);
    if (isNew) return &chain;  // where it stays: a map's elements do not move
    for (std::size_t i = 0; i < chain.levels.size(); ++i) give(job, i + 1, chain.levels[i], chain.cached);
    if (chain.complete) count(job, job.source->triangleCount());
    return nullptr;
}

void LodBuilder::State::hand(Chain& chain, LodLevel level) {
    const std::lock_guard lock(mutex_);
    for (Job* user : chain.users) give(*user, chain.levels.size() + 1, level, chain.cached);
    chain.levels.push_back(std::move(level));
}

void LodBuilder::State::complete(Chain& chain) {
    const std::lock_guard lock(mutex_);
    chain.complete = true;
    for (Job* user : chain.users) count(*user, user->source->triangleCount());
}

void LodBuilder::State::give(Job& job, std::size_t level, const LodLevel& data, bool cached) {
    ready_.push_back({job.mesh, job.primitive, static_cast<int>(level), data, cached});
    // Time goes with the triangles that are taken away
    count(job, job.source->triangleCount() - data.indices.size() / 3);
}

void LodBuilder::State::count(Job& job, std::size_t triangles) {
    trianglesDone_ += triangles - job.counted;
    job.counted = triangles;
}

bool LodBuilder::State::readInto(Chain& chain, const fs::path& file, const Primitive& primitive) {
    try {
        auto levels = readLods(file, primitive);
        if (!levels) return false;
        chain.cached = true;
        for (LodLevel& level : *levels) hand(chain, std::move(level));
        return true;
    } catch (const InputError& problem) {
        if (!broken_.exchange(true))
            logWarning(fmt::format("{}: it is made anew, as are all others that are broken", problem.what()));
        return false;
    }
}

void LodBuilder::State::write(const fs::path& file, const std::string& bytes) {
    // One at a time: only one unfinished file is removed when a signal ends the program.
    const std::lock_guard lock(writing_);
    std::error_code ignored;
    fs::create_directories(folder_, ignored);
    // What is no file goes: to open a pipe that nobody reads takes for ever.
    if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) fs::remove(file, ignored);
    try {
        writeFileAtomically(file, bytes);
    } catch (const std::runtime_error& failure) {
        if (!unwritable_.exchange(true))
            logWarning(fmt::format("{}; levels of detail are made each time", failure.what()));
    }
}

LodBuilder::LodBuilder(const Scene& scene, const LodOptions& options)
    : state_(std::make_unique<State>(scene, options)) {}
LodBuilder::~LodBuilder() = default;
std::vector<BuiltLevel> LodBuilder::take() {
    return state_->take();
}
bool LodBuilder::finished() const {
    return state_->finished();
}
void LodBuilder::wait() const {
    state_->wait();
}
double LodBuilder::progress() const {
    return state_->progress();
}

std::vector<BuiltLevel> buildLevels(const Scene& scene, const LodOptions& options,
                                    const std::function<bool()>& stopped) {
    constexpr auto kStep = std::chrono::milliseconds(20);
    constexpr int kQuietSteps = 10;
    constexpr std::size_t kPercent = 100;
    LodBuilder builder(scene, options);
    std::optional<ProgressLine> line;
    for (int steps = 0; !builder.finished() && !stopped(); ++steps) {
        std::this_thread::sleep_for(kStep);
        if (steps < kQuietSteps) continue;
        if (!line) line.emplace("making levels of detail, percent", kPercent);
        line->update(static_cast<std::size_t>(builder.progress() * kPercent));
    }
    return builder.take();
}

}  // namespace dioptre
