#include "options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/image.hpp"
#include "core/text.hpp"
#include "scene/builtin.hpp"

#ifndef DIOPTRE_VERSION
#define DIOPTRE_VERSION "0.1.0"
#endif

namespace dioptre {

namespace {

constexpr double kMinFps = 0.001, kMaxFps = 1000.0;
constexpr int kMaxFrames = 1000000;
constexpr int kMaxReferenceSamples = 32768;  // twice that is the most of --samples
constexpr int kLeastCompared = 11;           // px; the SSIM's window
constexpr std::size_t kHelpColumns = 100, kHelpIndent = 30;

/// Settings in the order of the command line, applied once the config file is read.
using GivenSettings = std::vector<std::pair<std::string_view, std::string>>;

/// CLI11's layout, with long descriptions broken into lines and without its doubled blank lines.
class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter() { column_width(kHelpIndent); }

    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
        const std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
        std::string out;
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            if (end > begin || !out.ends_with("\n\n")) out += wrapped(text.substr(begin, end - begin)) + "\n";
            begin = end + 1;
        }
        return out;
    }

  private:
    static std::string wrapped(std::string line) {
        std::string out;
        const std::size_t indent = line.starts_with("  ") ? kHelpIndent : 0;
        while (line.size() > kHelpColumns) {
            const std::size_t space = line.rfind(' ', kHelpColumns);
            if (space == std::string::npos || space <= indent) break;
            out += line.substr(0, space) + "\n";
            line = std::string(indent, ' ') + line.substr(space + 1);
        }
        return out + line;
    }
};

// "[0..1000 mm; default 63]": what --help says after the meaning.
std::string helpOf(const Setting& setting) {
    std::string text(setting.help);
    if (setting.kind == SettingKind::boolean) return text;
    // How a text is written stands beside its name already.
    const std::string range = setting.form.empty() ? setting.rangeText() : std::string(setting.limits);
    const std::string fallback = setting.defaultText.empty() ? "" : "default " + setting.defaultText;
    if (range.empty() && fallback.empty()) return text;
    return text + " [" + range + (range.empty() || fallback.empty() ? "" : "; ") + fallback + "]";
}

/// `only` these; all where it is empty.
void addSettings(CLI::App& command, GivenSettings& given, const std::vector<std::string_view>& only = {}) {
    for (const Setting& setting : settingsTable()) {
        if (!only.empty() && std::find(only.begin(), only.end(), setting.name) == only.end()) continue;
        const std::string flag = "--" + std::string(setting.name);
        const auto keep = [&given, name = setting.name](const std::string& text) { given.emplace_back(name, text); };
        CLI::Option* option = nullptr;
        if (setting.kind == SettingKind::boolean) {
            // --swap-eyes=false takes back what a config file says
            const auto flagged = [keep](std::int64_t count) { keep(count > 0 ? "true" : "false"); };
            option = command.add_flag_function(flag, flagged, helpOf(setting));
        } else {
            option = command.add_option_function<std::string>(flag, keep, helpOf(setting));
            option->type_name(setting.form.empty() ? "VALUE" : std::string(setting.form));
        }
        std::string group(setting.group);
        group[0] = static_cast<char>(group[0] - 'a' + 'A');
        option->group(group)->take_last();
    }
}

void addConfig(CLI::App& command, Command& result) {
    command.add_option("--config", result.config, "JSON file of settings, see config/default.json; options given win")
        ->type_name("FILE")
        ->take_last();
    command.add_flag("--print-config", result.printConfig,
                     "print all settings as JSON, as --config reads it, and stop");
}

void addLog(CLI::App& command, Command& result) {
    command.add_option("--log", result.log, "CSV to write: time, gaze, focus, pupil, plan and ms of each frame")
        ->type_name("FILE")
        ->take_last();
}

/// A range as settings have it, said as they say it.
CLI::Validator within(double least, double most, bool whole) {
    const auto check = [=](const std::string& text) -> std::string {
        const auto number = parseNumber(text);
        if (number && *number >= least && *number <= most && (!whole || parseInteger(text))) return {};
        return fmt::format("{} is {}, it takes {}..{}", number ? text : quote(text),
                           number && whole && !parseInteger(text) ? "no whole number" : "not allowed", least, most);
    };
    return {check, ""};
}

std::string builtinList() {
    return fmt::format("{}", fmt::join(builtinNames(), ", "));
}

void addScene(CLI::App& command, Command& result) {
    command
        .add_option("SCENE", result.scene,
                    "glTF file (.glb or .gltf), or one that comes with the program, builtin:NAME: " + builtinList() +
                        "; not given: builtin:studio")
        ->type_name("FILE|builtin:NAME")
        ->check(CLI::Validator([](const std::string& name) { return name.empty() ? "is empty" : std::string(); }, ""));
}

void addMeasure(CLI::App& command, Command& result, std::vector<std::string>& sizes) {
    MeasureOptions& options = result.measure;
    command
        .add_option("SCENE", options.scenes,
                    "glTF files (.glb or .gltf), or builtin:NAME: " + builtinList() + "; not given: all of these")
        ->type_name("FILE|builtin:NAME");
    command.add_option("--out", result.out, "folder for trade.csv, trade.json, trade-RENDERER.json and index.html")
        ->type_name("FOLDER")
        ->take_last();
    command.add_option("--size", sizes, "size of the pictures, more than one with commas [default 640x480]")
        ->type_name("WxH,...")
        ->delimiter(',');
    command
        .add_option("--samples", options.samples,
                    "points of the lens in each of the reference's two halves [1..32768; default 256]")
        ->type_name("N")
        ->take_last()
        ->check(within(1, kMaxReferenceSamples, true));
    command.add_flag("--quick", options.quick, "studio alone, 320x240, 64 samples, where not told otherwise");
    command.add_flag("--resume", options.resume, "keep what the folder holds already, measure the rest");
}

void addBudget(CLI::App& command, Command& result) {
    BudgetOptions& options = result.budget;
    command.add_option("--out", result.out, "folder for frames.csv, budget.json and index.html, a page to look at")
        ->type_name("FOLDER")
        ->take_last();
    command
        .add_option("--frames", options.frames,
                    "length of the run [1..1000000; default: as long as the traces play, without any 300]")
        ->type_name("N")
        ->take_last()
        ->check(within(1, kMaxFrames, true));
    command
        .add_option(
            "--hz", options.hz,
            "moments a second, however long a frame takes; without --budget-ms a frame has the time between two "
            "[0.001..1000; default 1000 / --budget-ms]")
        ->type_name("R")
        ->take_last()
        ->check(within(kMinFps, kMaxFps, false));
    command
        .add_option(
            "--reference-every", options.referenceEvery,
            "compare each K-th frame with the reference, untimed; 0: none [0..1000000; default: about ten in all]")
        ->type_name("K")
        ->take_last()
        ->check(within(0, kMaxFrames, true));
    command
        .add_option("--reference-samples", options.referenceSamples,
                    "points of the lens in that reference [1..65536; default 256]")
        ->type_name("N")
        ->take_last()
        ->check(within(1, 2 * kMaxReferenceSamples, true));
    command
        .add_option("--fail-missed", options.failMissed,
                    "exit with 1 where more of the frames took longer than the budget [0..100 %]")
        ->type_name("PERCENT")
        ->take_last()
        ->check(within(0, 100, false));
    command
        .add_option("--fail-ssim", options.failSsim,
                    "exit with 1 where the mean SSIM against the reference is lower [0..1]")
        ->type_name("S")
        ->take_last()
        ->check(within(0, 1, false));
}

void addExamples(CLI::App& app) {
    app.footer(
        "dioptre COMMAND --help tells the options of a command.\n"
        "Exit code: 0 done, 1 the run failed, 2 wrong usage or bad input.");
    app.get_subcommand("render")->footer(
        "Examples:\n"
        "  dioptre render my.glb --out both.png --aperture-mm 8 --gaze 0.3,0.6\n"
        "  dioptre render my.glb --out left.exr --eye left --focus 1.5 --size 1280x960\n"
        "  dioptre render my.glb --out later.png --time 2.5\n"
        "  dioptre render my.glb --out folder --frames 90 --gaze-trace gaze.csv --log frames.csv");
    app.get_subcommand("view")->footer(
        "Examples:\n"
        "  dioptre view my.glb --display anaglyph --aperture-mm 8\n"
        "  dioptre view my.glb --lens eye-60 --eye centre");
    app.get_subcommand("inspect")->footer(
        "Examples:\n"
        "  dioptre inspect my.glb --lens eye-60 --focus 0.4\n"
        "  dioptre inspect my.glb --lods");
    app.get_subcommand("compare")->footer("Example: dioptre compare reference.pfm mine.png");
    app.get_subcommand("measure")->footer(
        "Examples:\n"
        "  dioptre measure --out trade\n"
        "  dioptre measure my.glb --out trade --size 640x480,1280x960\n"
        "  dioptre measure --quick --out quick");
    app.get_subcommand("budget")->footer(
        "Without --head-trace, --gaze-trace and --gaze a seated viewer looks around, assets/traces/seated.*.\n"
        "Examples:\n"
        "  dioptre budget my.glb --budget-ms 100 --out run\n"
        "  dioptre budget my.glb --hz 90 --head-trace head.csv --gaze-trace gaze.csv --out run\n"
        "  dioptre budget my.glb --budget-ms 100 --technique mipmap --out held\n"
        "  dioptre budget my.glb --budget-ms 100 --fail-missed 5 --fail-ssim 0.95 --out check");
    app.get_subcommand("export")->footer("Example: dioptre export toys --out toys.glb");
}

// Everything that no option and no positional took: name the first and its nearest relative.
void rejectExtras(const CLI::App& app) {
    const std::vector<std::string> extras = app.remaining();
    if (extras.empty()) return;
    const auto dashed =
        std::find_if(extras.begin(), extras.end(), [](const std::string& s) { return s.starts_with('-'); });
    // A misspelt command comes first, and with it all that was meant for it.
    const bool isCommand = app.get_parent() == nullptr && !extras.front().starts_with('-');
    const bool isOption = !isCommand && dashed != extras.end();
    const std::string& first = isOption ? *dashed : extras.front();

    std::vector<std::string> owned;
    if (isCommand) {
        for (const CLI::App* sub : app.get_subcommands({})) owned.push_back(sub->get_name());
    } else {
        for (const CLI::Option* option : app.get_options()) owned.push_back(option->get_name());
    }
    const std::vector<std::string_view> names(owned.begin(), owned.end());
    const std::string text = isOption ? first.substr(0, first.find('=')) : first;
    const std::string_view nearest = isOption || isCommand ? nearestName(text, names) : std::string_view();
    throw InputError((isOption    ? "unknown option "
                      : isCommand ? "unknown command "
                                  : "unexpected argument ") +
                     quote(text) + (nearest.empty() ? "" : ", did you mean " + quote(nearest)));
}

void checkExport(Command& command) {
    if (command.scene.empty()) throw InputError("export: NAME is missing, one of " + builtinList());
    command.scene = requireBuiltinName(command.scene);
    if (command.out.empty()) throw InputError("export: --out FILE is missing");
    if (command.out.extension() != ".glb")
        throw InputError("export: " + quote(command.out.string()) + " must end in .glb");
}

void checkMeasure(Command& command, const std::vector<std::string>& sizes) {
    if (command.out.empty()) throw InputError("measure: --out FOLDER is missing");
    for (const std::string& size : sizes) {
        Settings one;
        try {
            applySetting(one, "size", size);
        } catch (const InputError& error) {
            throw InputError("--" + std::string(error.what()));
        }
        if (std::find(command.measure.sizes.begin(), command.measure.sizes.end(), one.view.size) ==
            command.measure.sizes.end())
            command.measure.sizes.push_back(one.view.size);
    }
}

void checkBudget(Command& command, const GivenSettings& given) {
    std::optional<double>& milliseconds = command.settings.render.budgetMs;
    BudgetOptions& options = command.budget;
    if (command.out.empty()) throw InputError("budget: --out FOLDER is missing");
    if (!milliseconds && !options.hz) throw InputError("budget: --budget-ms MS or --hz R is missing");
    if (!milliseconds) milliseconds = 1000.0 / *options.hz;
    if (!options.hz) options.hz = 1000.0 / *milliseconds;
    if (command.settings.render.show.stage != ShowChoice::none)
        throw InputError("budget: --show draws a stage in place of the picture, a run is of pictures");
    const FocusSettings& focus = command.settings.focus;
    const bool gazeGiven = std::any_of(given.begin(), given.end(), [](const auto& g) { return g.first == "gaze"; });
    options.looksAround =
        focus.headTrace.empty() && focus.gazeTrace.empty() && !gazeGiven && focus.gaze == FocusSettings().gaze;
    const bool compares = options.referenceEvery != 0;
    if (options.failSsim && !compares)
        throw InputError("budget: --fail-ssim needs frames that are compared, --reference-every 0 compares none");
    const PictureSize& size = command.settings.view.size;
    if (compares && std::min(size.width, size.height) < kLeastCompared)
        throw InputError(
            fmt::format("--size: {}x{} is too small to be compared, at least {}x{}; or --reference-every 0", size.width,
                        size.height, kLeastCompared, kLeastCompared));
}

std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

}  // namespace

std::string programVersion() {
    return DIOPTRE_VERSION;
}

Command parseCommandLine(int argc, const char* const* argv) {
    Command result;
    GivenSettings given;

    CLI::App app("Dioptre: a stereo viewer for glTF scenes that sees as an eye does.", "dioptre");
    app.set_version_flag("--version", "dioptre " DIOPTRE_VERSION);
    app.require_subcommand(0, 1);  // none is an error below, after misspelt ones
    app.allow_extras();
    app.formatter(std::make_shared<HelpFormatter>());
    app.set_help_flag("-h,--help", "print this help and stop");
    app.get_option("--version")->description("print the version and stop");

    CLI::App* render = app.add_subcommand("render", "draw one picture, or a sequence, into files; needs no display");
    addScene(*render, result);
    render
        ->add_option("--out", result.out,
                     "picture to write (.png in sRGB, .exr or .pfm linear); with --frames: a folder")
        ->type_name("FILE|FOLDER")
        ->take_last();
    render
        ->add_option("--frames", result.frames,
                     "length of a sequence, written with a page to look at [1..1000000; default 1: one picture]")
        ->type_name("N")
        ->take_last()
        ->check(within(1, kMaxFrames, true));
    render->add_option("--fps", result.fps, "pictures per second of the sequence [0.001..1000; default 30]")
        ->type_name("R")
        ->take_last()
        ->check(within(kMinFps, kMaxFps, false));
    CLI::App* view = app.add_subcommand(
        "view",
        "show the scene in a window; the pointer is the gaze, F1 lists keys, F2 opens the settings, Escape closes");
    addScene(*view, result);
    view->add_option(
            "--gaze-input", result.gazeInput,
            "live samples of an eye tracker, lines t_s,x,y,valid, in place of the pointer: on standard input, or "
            "to a UDP port of this machine")
        ->type_name("stdin|udp:PORT")
        ->take_last();
    for (CLI::App* command : {render, view}) addLog(*command, result);
    CLI::App* inspect = app.add_subcommand(
        "inspect", "tell what a scene holds, what the lens can do with it, and what a view of it costs");
    addScene(*inspect, result);
    inspect->add_flag("--lods", result.lods,
                      "make the levels of detail of its meshes and tell what they are; nothing is drawn");
    for (CLI::App* command : {render, view, inspect}) {
        addConfig(*command, result);
        addSettings(*command, given);
    }
    CLI::App* compare = app.add_subcommand("compare", "tell how far two pictures are apart: PSNR, SSIM and FLIP");
    compare->add_option("A", result.compareA, "reference picture (.png, .exr or .pfm)")->type_name("FILE");
    compare->add_option("B", result.compareB, "picture of the same size that is compared with it")->type_name("FILE");
    compare
        ->add_option("--out", result.out,
                     "map of FLIP's error: .png in colours from black, 0, to yellow, 1; .exr and .pfm hold the values")
        ->type_name("FILE")
        ->take_last();
    CLI::App* exporter =
        app.add_subcommand("export", "write a scene that comes with the program as a binary glTF file");
    exporter->add_option("NAME", result.scene, "which one: " + builtinList())->type_name("");
    exporter->add_option("--out", result.out, "file to write (.glb)")->type_name("FILE")->take_last();
    CLI::App* measure = app.add_subcommand(
        "measure", "measure how fast and how accurate each technique is: tables, and a page to look at");
    std::vector<std::string> sizes;
    addMeasure(*measure, result, sizes);
    addSettings(*measure, given, {"camera", "pose", "exposure", "context"});
    CLI::App* budget = app.add_subcommand(
        "budget", "play head and gaze traces against a budget of milliseconds a frame, and tell what it gave");
    addScene(*budget, result);
    addBudget(*budget, result);
    addConfig(*budget, result);
    addSettings(*budget, given);
    const auto commands = {render, view, inspect, compare, measure, budget, exporter};
    for (CLI::App* command : commands) command->allow_extras();
    addExamples(app);

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
        app.exit(asked);
        return result;
    } catch (const CLI::ParseError& error) {
        for (const CLI::App* command : commands) rejectExtras(*command);
        throw InputError(oneLine(error.what()));
    } catch (const std::logic_error&) {  // CLI11 reads a flag's value with std::stoll
        throw InputError("a flag's value must be true or false");
    }
    for (const CLI::App* command : commands) rejectExtras(*command);
    rejectExtras(app);
    if (app.get_subcommands().empty())
        throw InputError(
            "no command given: view, render, inspect, measure, budget, compare or export, see dioptre --help");

    if (!result.config.empty()) loadSettings(result.config, result.settings);
    for (const auto& [name, text] : given) {
        try {
            applySetting(result.settings, name, text);
        } catch (const InputError& error) {
            throw InputError("--" + std::string(error.what()));
        }
    }
    result.which = render->parsed()    ? Command::Which::render
                   : view->parsed()    ? Command::Which::view
                   : inspect->parsed() ? Command::Which::inspect
                   : compare->parsed() ? Command::Which::compare
                   : measure->parsed() ? Command::Which::measure
                   : budget->parsed()  ? Command::Which::budget
                                       : Command::Which::exportScene;
    if (result.which == Command::Which::render && !result.printConfig) {
        if (result.out.empty()) throw InputError("render: --out FILE is missing");
        if (result.frames == 1) requireImageName(result.out);
        if (result.frames > 1 && isImageName(result.out))
            throw InputError(fmt::format("--out {}: {} frames go into a folder, this is the name of a picture",
                                         result.out.string(), result.frames));
    }
    if (result.which == Command::Which::compare && result.compareB.empty())
        throw InputError("compare: two pictures are needed, A and B");
    if (result.which == Command::Which::compare && !result.out.empty()) requireImageName(result.out);
    if (result.which == Command::Which::exportScene) checkExport(result);
    if (result.which == Command::Which::measure) checkMeasure(result, sizes);
    if (result.which == Command::Which::budget && !result.printConfig) checkBudget(result, given);
    return result;
}

}  // namespace dioptre
