// Messages for people, to stderr (pictures and tables go to files, answers to stdout) and, when asked, to a file too.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace dioptre {

enum class LogLevel { debug, info, warning, error };

/// Least severe level that is shown; info unless told.
void setLogLevel(LogLevel level);

/// Also writes every message, with its time and level, to `file` (replaced). InputError where that cannot be opened.
void logToFile(const std::filesystem::path& file);

void logDebug(std::string_view message);
void logInfo(std::string_view message);
void logWarning(std::string_view message);  // "warning: ..."
void logError(std::string_view message);    // "error: ..."

/// "LABEL 12/64 NOTE": rewritten in place where stderr is a terminal, otherwise one line per tenth of the way. Finishes
/// its line when it goes away. One at a time.
class ProgressLine {
  public:
    ProgressLine(std::string label, std::size_t total);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void update(std::size_t done, std::string_view note = {});

  private:
    std::string label_;
    std::size_t total_;
    std::size_t shownTenths_ = 0;
    bool terminal_;
};

}  // namespace dioptre
