// The command line: subcommands, and one option per row of the settings table. CLI11 stays in options.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/settings.hpp"

namespace dioptre {

/// Of `measure` alone.
struct MeasureOptions {
    std::vector<std::string> scenes;  // files or builtin:NAME; empty: all that come with the program
    std::vector<PictureSize> sizes;   // empty: 640x480
    std::optional<int> samples;       // of each half of the reference; none: 256
    bool quick = false, resume = false;
};

/// Of `budget` alone; of a frame's time, settings.render.budgetMs.
struct BudgetOptions {
    std::optional<int> frames;          // none: as long as the traces play
    std::optional<double> hz;           // moments a second; none: 1000 / budgetMs
    std::optional<int> referenceEvery;  // 0: never; none: about ten times in all
    int referenceSamples = 256;
    bool looksAround = false;          // nobody said what gaze and head do
    std::optional<double> failMissed;  // percent of the frames, at most
    std::optional<double> failSsim;    // mean, at least
};

struct Command {
    enum class Which { nothingToDo, view, render, inspect, compare, exportScene, measure, budget };

    Which which = Which::nothingToDo;  // --help or --version was printed, or --print-config asked for alone
    std::string scene;                 // a file or builtin:NAME; empty: the studio. export: NAME or builtin:NAME
    std::filesystem::path out;         // render: picture, or folder of a sequence; export: GLB file;
                                       // measure, budget: folder
    int frames = 1;                    // render: > 1 draws a sequence into the folder `out`
    double fps = 30.0;                 // of the sequence, frames per second
    std::string compareA, compareB;    // compare: two picture files; their error map goes to `out`
    MeasureOptions measure;
    BudgetOptions budget;
    bool lods = false;             // inspect: tell of the levels of detail alone
    std::filesystem::path log;     // render, view: CSV of what was shown; empty: none
    std::string gazeInput;         // view: where gaze samples come from; empty: nowhere
    std::filesystem::path config;  // already read into settings
    bool printConfig = false;      // print printSettings(settings) and stop
    Settings settings;             // defaults < config < command line
};

/// InputError (one line, the nearest known option for a misspelt one) for wrong usage or a bad config file. `--help`
/// and `--version` print to stdout here and give nothingToDo.
Command parseCommandLine(int argc, const char* const* argv);

/// "0.1.0"
std::string programVersion();

}  // namespace dioptre
