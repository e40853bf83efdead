#include "viewer/live_gaze.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"

namespace dioptre {

namespace {

constexpr std::size_t kLongestLine = 4096;  // bytes; what has as many is no sample

/// "0.5,0.25,0.75,1"; none where it is anything else.
std::optional<GazeSample> parseSample(std::string_view line) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    std::array<double, 4> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t comma = line.find(',');
        if ((comma == std::string_view::npos) != (i + 1 == values.size())) return std::nullopt;
        const auto value = parseNumber(line.substr(0, comma));
        if (!value) return std::nullopt;
        values[i] = *value;
        line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
    }
    const auto& [time, x, y, valid] = values;
    if (!std::isfinite(time) || (valid != 0.0 && valid != 1.0)) return std::nullopt;
    GazeSample sample{time, {0.5, 0.5}, valid == 1.0};
    const bool placed = std::isfinite(x) && std::isfinite(y);
    if (sample.valid && !placed) return std::nullopt;
    if (placed) sample.position = {x, y};
    return sample;
}

int openPort(std::string_view port) {
    const auto number = parseInteger(port);
    if (!number || *number < 1 || *number > 65535)
        throw InputError(fmt::format("--gaze-input: port {}, must be 1..65535", quote(port)));
    const int file = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(*number));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (file < 0 || ::bind(file, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
        const std::string reason = std::strerror(errno);
        if (file >= 0) ::close(file);
        throw InputError(fmt::format("--gaze-input: UDP port {}: {}", *number, reason));
    }
    return file;
}

}  // namespace

void LiveGaze::add(std::string_view bytes, double now) {
    for (std::size_t begin = 0; begin < bytes.size();) {
        const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
        rest_ += bytes.substr(begin, std::min(end - begin, kLongestLine - std::min(rest_.size(), kLongestLine)));
        begin = end + 1;
        if (end == bytes.size()) return;
        take(rest_, now);
        rest_.clear();
    }
}

void LiveGaze::take(std::string_view line, double now) {
    if (line.empty() || line.front() == '#') return;
    const auto sample = line.size() < kLongestLine ? parseSample(line) : std::nullopt;
    // A clock that goes back by more than that was started anew.
    constexpr double kRestart = 1.0;
    const double back = sample && latest_ ? latest_->time - sample->time : 0.0;
    if (!sample || (back > 0.0 && back <= kRestart)) {
        ++refused_;
        return;
    }
    if (back > kRestart) span_.reset(), before_.reset();
    latest_ = sample;
    arrived_ = now;
    // The least of this span of time and of the one before: a clock that jumped or drifts is believed again soon.
    constexpr double kSpan = 2.0;  // seconds
    const double took = now - sample->time;
    if (span_ && now - span_->begin > kSpan) before_ = std::exchange(span_, std::nullopt);
    if (!span_) span_ = {now, took};
    span_->least = std::min(span_->least, took);
    offset_ = before_ ? std::min(before_->least, span_->least) : span_->least;
}

GazeSample LiveGaze::at(double now) const {
    if (!latest_) return {now, {0.5, 0.5}, false};
    const bool fresh = now - (latest_->time + offset_) < kDropout;
    return {now, latest_->position, latest_->valid && fresh};
}

GazeInput::GazeInput(const std::string& source) {
    constexpr std::string_view kUdp = "udp:";
    if (source == "stdin") {
        file_ = STDIN_FILENO;
    } else if (source.starts_with(kUdp)) {
        datagrams_ = true;
        file_ = openPort(std::string_view(source).substr(kUdp.size()));
    } else {
        throw InputError(fmt::format("--gaze-input: {} is not stdin|udp:PORT", quote(source)));
    }
}

GazeInput::~GazeInput() {
    if (datagrams_) ::close(file_);
}

void GazeInput::read(double now) {
    // More than a pipe or a socket holds, so that what is newest is never left waiting; but a source that is faster than
    // we are must not keep the window waiting.
    constexpr std::size_t kMostBytes = std::size_t{1} << 18;
    constexpr int kMostReads = 1024;
    std::array<char, 65536> bytes{};
    std::size_t taken = 0;
    for (int i = 0; i < kMostReads && taken < kMostBytes && !ended_; ++i) {
        pollfd ready{file_, POLLIN, 0};
        if (::poll(&ready, 1, 0) <= 0) return;
        const ssize_t count = ::read(file_, bytes.data(), bytes.size());
        if (count < 0) return;
        ended_ = count == 0 && !datagrams_;
        taken += static_cast<std::size_t>(count);
        gaze_.add({bytes.data(), static_cast<std::size_t>(count)}, now);
        if (datagrams_) gaze_.endLine(now);
    }
}

}  // namespace dioptre
