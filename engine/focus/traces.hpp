// Recorded gaze and head movement: CSV files, one header line, then one sample per line.
//   gaze: t_s,x,y,valid              seconds; 0..1 from the picture's top left (a gaze may leave the picture); 0 or 1
//   head: t_s,x,y,z,qx,qy,qz,qw      seconds, metres, quaternion of any length but 0; world from head
// Times do not decrease. Blank lines, lines that begin with '#', Windows line ends and blanks around a field are fine.
// An invalid gaze sample may have nan for x and y. Numbers are read the same way in every locale.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "optics/view.hpp"

namespace dioptre {

struct GazeSample {
    double time = 0.0;              // seconds
    glm::dvec2 position{0.5, 0.5};  // 0..1 from the top left of the eye's picture
    bool valid = false;
};

struct HeadSample {
    double time = 0.0;  // seconds
    Pose pose;          // unit quaternion
};

/// Throw InputError (file, line, column, value) for a file that breaks the rules above or has no sample.
std::vector<GazeSample> readGazeTrace(const std::filesystem::path& file);
std::vector<HeadSample> readHeadTrace(const std::filesystem::path& file);

/// A file's text, which reads back to the same bits.
std::string gazeTraceCsv(std::span<const GazeSample> trace);
std::string headTraceCsv(std::span<const HeadSample> trace);

/// Latest sample that is not after `time`; an invalid one where none is.
GazeSample gazeAt(std::span<const GazeSample> trace, double time);

/// Position linear, orientation spherical (the short way) between neighbours; the first or last pose outside the trace;
/// the identity for an empty one.
Pose headPoseAt(std::span<const HeadSample> trace, double time);

}  // namespace dioptre
