// Small helpers for one-line messages and for numbers as text, independent of the locale.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dioptre {

/// In quotes, control characters replaced, cut after 60 bytes: safe to put into a one-line message.
std::string quote(std::string_view text);

/// The whole of `text` as a number ("inf" and "nan" included); none where anything else is in it.
std::optional<double> parseNumber(std::string_view text);
std::optional<int> parseInteger(std::string_view text);

/// Shortest text that reads back to the same bits.
std::string printNumber(double value);

/// The name nearest to `text` by edit distance; empty where none is near enough to be a misspelling.
std::string_view nearestName(std::string_view text, std::span<const std::string_view> names);

}  // namespace dioptre
