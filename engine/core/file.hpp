// Whole files: a write that either happens completely or leaves no trace, a bounded read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace dioptre {

/// Makes a folder to write into, and those above it; one that is there is fine. InputError where something else has its
/// name. RunError: no permission, any other failure. `option` begins the message: "--out".
void makeFolder(const std::filesystem::path& path, std::string_view option);

/// Writes to a temporary file in the same folder, then renames it over `path`, so that nobody ever sees half a file and
/// a failure keeps what was there. A link is followed; a device or pipe is written directly, and so is what /dev/stdout
/// or /dev/fd/3 stands for, even a file.
/// InputError: the folder is missing, or `path` is a folder. RunError: no permission, disk full, any other failure.
void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes);

/// For a signal handler that is about to end the program: removes the temporary file of a write under way.
void removeUnfinishedFile();

/// InputError where `path` cannot name a file to be written (its folder is missing, it is a folder). Asked before a
/// long run, so that it does not fail at its end.
void requireWritableName(const std::filesystem::path& path);

/// The bytes of a file. InputError: missing, unreadable, a folder, or longer than `limitBytes`.
std::string readFile(const std::filesystem::path& path, std::size_t limitBytes);

}  // namespace dioptre
