// The subcommands, one file each. Each throws InputError (exit code 2) or RunError (1).
#pragma once

#include <functional>
#include <memory>

#include "gl/context.hpp"
#include "options.hpp"
#include "scene/scene.hpp"

namespace dioptre {

/// The scene that the command line names, a file or builtin:NAME, else the studio; its warnings go to the log.
/// `progress` is told, now and then, the share that is done, 0..1.
Scene loadScene(const Command& command, const std::function<void(double)>& progress = {});

/// What a single picture may take where nobody says.
inline constexpr double kPictureMs = 1000.0;

/// "auto"
std::string_view contextName(const Command& command);
/// The context that --context names, made current.
std::unique_ptr<Context> openHeadlessContext(const Command& command);

void runRender(const Command& command);
void runView(const Command& command);
void runInspect(const Command& command);
void inspectLods(const Scene& scene);  // inspect --lods
void runCompare(const Command& command);
void runExport(const Command& command);
void runMeasure(const Command& command);
void runBudget(const Command& command);

/// The source that the program was built of, as git describes it; "unknown".
std::string sourceCommit();

}  // namespace dioptre
