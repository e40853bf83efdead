// Gaze samples that arrive while the window is open: lines `t_s,x,y,valid` (focus/traces.hpp) on standard input, or in
// datagrams to a UDP port of this machine. Plain arithmetic in LiveGaze, reading in GazeInput.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "focus/traces.hpp"

namespace dioptre {

class LiveGaze {
  public:
    /// Bytes as they came, cut anywhere; `now` in seconds, by our clock. Lines that are no samples are counted and passed
    /// over, so is a sample that is older than one before it. A tracker's clock may start anywhere, run a little too fast
    /// or too slow, jump, and start anew.
    void add(std::string_view bytes, double now);
    /// After a datagram: what it ended with is a whole line.
    void endLine(double now) { add("\n", now); }

    /// The newest sample, with `now` as its time; not valid where none came for kDropout: a tracker that is lost is as
    /// good as a blink.
    GazeSample at(double now) const;
    /// Whether one came within the last second.
    bool alive(double now) const { return latest_ && now - arrived_ < 1.0; }
    std::size_t refused() const { return refused_; }

    static constexpr double kDropout = 0.15;  // seconds: of 30 Hz some four samples

  private:
    void take(std::string_view line, double now);

    std::string rest_;  // of a line
    std::optional<GazeSample> latest_;
    double arrived_ = 0.0;
    // Between the tracker's clock and ours: the least that a sample took to come, of late. More than that is its age.
    double offset_ = 0.0;
    struct Span {
        double begin = 0.0, least = 0.0;  // seconds
    };
    std::optional<Span> span_, before_;
    std::size_t refused_ = 0;
};

/// Where samples come from: "stdin" or "udp:PORT".
class GazeInput {
  public:
    /// InputError for anything else, and where the port is not free.
    explicit GazeInput(const std::string& source);
    ~GazeInput();
    GazeInput(const GazeInput&) = delete;
    GazeInput& operator=(const GazeInput&) = delete;

    /// What came since the last call; does not wait, nor take all of a source that never ends.
    void read(double now);
    const LiveGaze& gaze() const { return gaze_; }

  private:
    LiveGaze gaze_;
    int file_ = -1;
    bool datagrams_ = false, ended_ = false;
};

}  // namespace dioptre
