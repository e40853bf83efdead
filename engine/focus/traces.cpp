#include "focus/traces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/text.hpp"

namespace dioptre {

namespace {

constexpr std::size_t kLimitBytes = std::size_t{1} << 28;  // a day of samples at 30 Hz; more is no trace

std::string_view trimmed(std::string_view text) {
    const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
    return text;
}

/// Hands out the lines that carry data, split at commas into exactly the columns of the header.
template <std::size_t Columns>
class TraceReader {
  public:
    using Names = std::array<std::string_view, Columns>;

    TraceReader(const std::filesystem::path& file, const Names& names)
        : file_(file.string()), text_(readFile(file, kLimitBytes)), rest_(text_), names_(names) {
        constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
        if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
        const std::string header = fmt::format("{}", fmt::join(names, ","));
        std::string_view line;
        if (!nextLine(line)) fail(fmt::format("holds no line of data, must begin with the header {}", header));
        split(line);
        if (fields_ != names_) fail(fmt::format("header {}, must be {}", quote(line), header));
    }

    bool nextRow() {
        std::string_view line;
        if (!nextLine(line)) return false;
        split(line);
        return true;
    }

    double number(std::size_t column, bool mayBeNan = false) const {
        const std::string_view field = fields_[column];
        // A leading '+' is no number to from_chars.
        const auto value = parseNumber(field.starts_with('+') ? field.substr(1) : field);
        if (!value || (!std::isfinite(*value) && !(mayBeNan && std::isnan(*value))))
            failAt(column, "must be a finite number");
        return *value;
    }

    /// The first column, which must not decrease.
    double time() {
        const double t = number(0);
        if (t < lastTime_) failAt(0, fmt::format("must not be before {}", lastTime_));
        return lastTime_ = t;
    }

    [[noreturn]] void failAt(std::size_t column, std::string_view what) const {
        fail(fmt::format("column {} ({}): {}, {}", column + 1, names_[column], quote(fields_[column]), what));
    }
    [[noreturn]] void fail(std::string_view what) const {
        throw InputError(line_ == 0 ? fmt::format("{}: {}", file_, what)
                                    : fmt::format("{}:{}: {}", file_, line_, what));
    }

  private:
    bool nextLine(std::string_view& line) {
        while (!rest_.empty()) {
            ++line_;
            const std::size_t end = std::min(rest_.find('\n'), rest_.size());
            line = trimmed(rest_.substr(0, end));
            rest_.remove_prefix(std::min(end + 1, rest_.size()));
            if (!line.empty() && line.front() != '#') return true;
        }
        return false;
    }

    void split(std::string_view line) {
        const auto count = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
        if (count != Columns) fail(fmt::format("{} columns, must be {}: {}", count, Columns, fmt::join(names_, ",")));
        for (std::string_view& field : fields_) {
            const std::size_t comma = std::min(line.find(','), line.size());
            field = trimmed(line.substr(0, comma));
            line.remove_prefix(std::min(comma + 1, line.size()));
        }
    }

    std::string file_, text_;
    std::string_view rest_;
    Names names_, fields_{};
    std::size_t line_ = 0;
    double lastTime_ = -HUGE_VAL;
};

glm::dquat unitQuaternion(const TraceReader<8>& reader) {
    glm::dvec4 q(reader.number(4), reader.number(5), reader.number(6), reader.number(7));  // x, y, z, w
    // Largest component first, so that neither huge nor tiny ones leave the range of a double when squared.
    const double largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), std::abs(q.w)});
    if (largest == 0.0) reader.fail("quaternion (qx,qy,qz,qw) 0,0,0,0, must not have length 0");
    q = glm::normalize(q / largest);
    return {q.w, q.x, q.y, q.z};
}

/// Index of the first sample after `time`.
template <class Sample>
std::size_t firstAfter(std::span<const Sample> trace, double time) {
    const auto found = std::upper_bound(trace.begin(), trace.end(), time,
                                        [](double t, const Sample& sample) { return t < sample.time; });
    return static_cast<std::size_t>(found - trace.begin());
}

}  // namespace

std::vector<GazeSample> readGazeTrace(const std::filesystem::path& file) {
    TraceReader<4> reader(file, {"t_s", "x", "y", "valid"});
    std::vector<GazeSample> trace;
    while (reader.nextRow()) {
        GazeSample sample;
        sample.time = reader.time();
        const double valid = reader.number(3);
        if (valid != 0.0 && valid != 1.0) reader.failAt(3, "must be 0 or 1");
        sample.valid = valid == 1.0;
        const glm::dvec2 position(reader.number(1, !sample.valid), reader.number(2, !sample.valid));
        if (std::isfinite(position.x) && std::isfinite(position.y)) sample.position = position;
        trace.push_back(sample);
    }
    if (trace.empty()) reader.fail("holds no sample, must hold at least 1");
    return trace;
}

std::vector<HeadSample> readHeadTrace(const std::filesystem::path& file) {
    TraceReader<8> reader(file, {"t_s", "x", "y", "z", "qx", "qy", "qz", "qw"});
    std::vector<HeadSample> trace;
    while (reader.nextRow()) {
        HeadSample sample;
        sample.time = reader.time();
        sample.pose.position = {reader.number(1), reader.number(2), reader.number(3)};
        sample.pose.orientation = unitQuaternion(reader);
        trace.push_back(sample);
    }
    if (trace.empty()) reader.fail("holds no sample, must hold at least 1");
    return trace;
}

std::string gazeTraceCsv(std::span<const GazeSample> trace) {
    std::string csv = "t_s,x,y,valid\n";
    for (const GazeSample& sample : trace)
        csv += fmt::format("{},{},{},{}\n", printNumber(sample.time), printNumber(sample.position.x),
                           printNumber(sample.position.y), sample.valid ? 1 : 0);
    return csv;
}

std::string headTraceCsv(std::span<const HeadSample> trace) {
    std::string csv = "t_s,x,y,z,qx,qy,qz,qw\n";
    for (const HeadSample& sample : trace) {
        const auto& [position, q] = sample.pose;
        csv += printNumber(sample.time);
        for (const double value : {position.x, position.y, position.z, q.x, q.y, q.z, q.w})
            csv += "," + printNumber(value);
        csv += "\n";
    }
    return csv;
}

GazeSample gazeAt(std::span<const GazeSample> trace, double time) {
    const std::size_t next = firstAfter(trace, time);
    if (next == 0 || std::isnan(time)) return {time, {0.5, 0.5}, false};
    return trace[next - 1];
}

Pose headPoseAt(std::span<const HeadSample> trace, double time) {
    if (trace.empty()) return {};
    const std::size_t next = firstAfter(trace, time);
    if (next == 0) return trace.front().pose;
    if (next == trace.size()) return trace.back().pose;
    const HeadSample &before = trace[next - 1], &after = trace[next];
    const double share = (time - before.time) / (after.time - before.time);
    return {glm::mix(before.pose.position, after.pose.position, share),
            glm::normalize(glm::slerp(before.pose.orientation, after.pose.orientation, share))};
}

}  // namespace dioptre
