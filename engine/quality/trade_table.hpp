// The measured trade of speed against accuracy, config/trade/*.json, and the errors that it lets expect elsewhere.
// What the files hold: governorTable in engine/frame/measure_rows.hpp, which writes them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "quality/plan.hpp"
#include "quality/view_class.hpp"

namespace dioptre {

struct TradeTable {
    struct Entry {
        std::size_t view = 0;       // of `views`
        double milliseconds = 0.0;  // > 0
        double error = 0.0;         // 1 - SSIM, 0..2
    };
    struct Row {
        Plan plan;
        std::vector<Entry> entries;  // one or more
    };
    std::string renderer;
    std::vector<ViewClass> views;
    std::vector<Row> rows;

    /// The plans without their numbers of samples, each once.
    std::vector<Plan> methods() const;
};

/// InputError naming the file and the element, "llvmpipe.json: plans[3].entries[0].ssim: 7, must be ...": unreadable,
/// broken JSON, nested too deep, a repeated key or entry, too many plans, another schema, a missing key, a wrong type,
/// a value out of range, an unknown view, nothing measured.
TradeTable readTradeTable(const std::filesystem::path& file);
TradeTable parseTradeTable(std::string_view json, std::string_view where);

/// How much of what a smaller size loses blur leaves to be seen, 0..1; CoC DIAMETER.
double scaleSeen(int eighths, double meanCocPx);

/// Expected error, 1 - SSIM, of every plan in one view. Of the measured views the nearest counts most; with less blur than
/// in any of them errors go on as they fall towards the least blurred, down to 0.25 px. Between measured numbers of
/// samples N, and beyond them, by straight lines in log N and log error; a method that was measured at one N takes the
/// reference's slope.
class ExpectedErrors {
  public:
    ExpectedErrors(const TradeTable& table, const ViewClass& view);

    /// 0..1; 1 for a method that the table does not have.
    double of(const Plan& plan) const;

  private:
    struct Point {
        double logSamples = 0.0, logError = 0.0;
    };
    struct Curve {
        Plan method;
        std::vector<Point> points;  // samples increase
    };
    double slopeOf(const Curve& curve, double logSamples) const;

    double meanCocPx_ = 0.0;
    double referenceSlope_ = 0.0;
    std::vector<Curve> curves_;
};

}  // namespace dioptre
