// What a run was measured with and on, as its JSON files begin.
#pragma once

#include <nlohmann/json.hpp>

#include "frame/measure_rows.hpp"

namespace dioptre {

inline nlohmann::ordered_json machineJson(const MeasuredWith& w) {
    return {{"program", w.program}, {"commit", w.commit}, {"renderer", w.renderer}, {"version", w.version},
            {"context", w.context}, {"cpu", w.cpu},       {"cores", w.cores},       {"memory_bytes", w.memoryBytes},
            {"system", w.system},   {"date", w.date},     {"load", w.load}};
}

}  // namespace dioptre
