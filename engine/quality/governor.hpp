// Chooses, each frame, the most accurate plan that the budget affords. Arithmetic on the times it is given: no clock.
//
// - It begins with the cheapest plan that gives the view what it requires, since the table may be another machine's.
//   What that took says what else is sure to fit: with the best of it it goes on.
// - It aims at 90 % of the budget: what is left is for what varies from frame to frame.
// - The number of samples follows the price: down at once, up by at most a tenth, or one, a frame. It goes down after
//   any missed frame, too.
// - The method (all of a plan but its samples) goes down at once where its price no longer fits. One frame far off its
//   price is a spike and moves only the samples; a second one is believed.
// - It goes up only to what is foreseen to fit for ten frames, at most once a second, and to a method that had to be
//   left again only after a wait that doubles each time, until load or view are others. What was never drawn may turn
//   out cheaper than its price: now and then, ever more seldom, it is tried.
// - Up to another technique it cross-fades where both plans fit together; down it does not.
// - While nobody sees (saccade, blink) the cheapest plan that has the blur is drawn; then the one from before goes on.
//   That is no change of method: nothing is tried, nothing counted.
// - Where nothing is blurred pinholes are enough, after ten frames of it; the plan from before goes on with the blur.
#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "quality/candidates.hpp"
#include "quality/plan.hpp"
#include "quality/price_model.hpp"
#include "quality/requirements.hpp"
#include "quality/trade_table.hpp"

namespace dioptre {

/// What there is to know before a frame.
struct Situation {
    double now = 0.0;       // seconds, by a clock that should not run backwards; if it does, frames' times stand in
    double budgetMs = 0.0;  // of a frame, all eyes; not > 0: the cheapest plan
    double refineMs =
        0.0;  // what a frame that refines a still view may take, where that is more; one sample in any case
    // What the frame of the last decision took, all eyes. None, or nonsense: nothing is learnt. None where something
    // else was drawn.
    std::optional<double> lastMs;
    bool lastRefined = false;  // that frame drew the refinement in place of the plan
    ViewClass view;
    Requirements requirements;
    bool unseen = false;  // a saccade or a blink
    bool alone = false;   // nothing was learnt and no frame follows: begins with what the table foresees to be best
};

enum class PlanChange {
    none,     // but for the number of samples
    up,       // to a better method
    down,     // to one that fits
    rested,   // to the cheap one that will do while nobody sees
    resumed,  // from there; a change of another kind in the same frame is told instead
    adapted,  // to what the view requires: blur came or went
};

struct Decision {
    struct Fade {
        static constexpr double kSeconds = 0.1;  // of a whole one
        Plan from;                               // to be drawn, too
        double weight = 0.0;                     // of `plan`'s picture, 0..1
    };
    /// Instead of drawing `plan` again, a view where nothing moves may go on with the reference.
    struct Refinement {
        Plan plan;
        int samplesNow = 0;       // that fit into this frame
        double foreseenMs = 0.0;  // of these
        int shownFrom = 0;        // samples: with fewer the picture of `plan` is closer
    };
    Plan plan;
    std::optional<Fade> fade;
    std::optional<Refinement> refinement;
    PlanChange change = PlanChange::none;
    double foreseenMs = 0.0;     // of `plan`, and of what it fades from
    double expectedError = 1.0;  // 1 - SSIM
    std::string_view why;        // one line
};

class Governor {
  public:
    explicit Governor(TradeTable table);

    Decision decide(const Situation& situation);

    const PriceModel& prices() const { return prices_; }

  private:
    /// What may have to be otherwise for a failed method to be worth another trial.
    struct Conditions {
        double load = 1.0, budgetMs = 0.0;
        ViewClass view;

        bool like(const Conditions& other) const;
    };
    struct Trial {
        int failures = 0;
        double until = 0.0;  // own clock
        Conditions at;
        int otherFrames = 0;             // in succession that conditions were others
        std::optional<PricedPlan> fits;  // as it may be tried, in this frame
        bool hoped = false;              // that is: it fits if it is cheaper than its price
        int foreseenFrames = 0;          // in succession that it fitted
    };
    struct Move {
        PlanChange change = PlanChange::none;
        std::string_view why;
    };

    void advanceClock(const Situation& s);
    Conditions conditions(const Situation& s) const;
    Move adapt(const Candidates& candidates, const Situation& s);
    Move goDown(const Candidates& candidates, const Situation& s, bool missed);
    Move goUp(const Candidates& candidates, const Situation& s);
    void grow(const Candidates& candidates, const Situation& s);
    void foresee(const Candidates& candidates, const Situation& s);
    std::optional<PricedPlan> affordable(const Plan& method, const Trial& trial, const Candidates& candidates,
                                         const Situation& s) const;
    std::optional<PricedPlan> better(const Candidates& candidates, const Situation& s) const;
    void enter(const PricedPlan& to, const Candidates& candidates, const Situation& s);
    void left(const Plan& method, const Situation& s);
    bool fadeFits(const Candidates& candidates, const Situation& s, const Plan& to) const;
    Decision decision(const Candidates& candidates, const Situation& s, Move move);

    TradeTable table_;
    PriceModel prices_;
    std::optional<Plan> current_;
    bool began_ = false;             // by what the first frame took
    std::optional<Plan> suspended_;  // goes on when something is blurred again
    int sharpFrames_ = 0;            // in succession
    bool sharp_ = false;             // the current plan is for a view without blur
    bool rested_ = false;
    struct {
        Plan from;
        double began = 0.0;
        bool running = false;
    } fade_;
    std::vector<std::pair<Plan, Trial>> trials_;          // of each method
    std::optional<std::pair<Plan, Conditions>> entered_;  // the current method, if it was gone up to
    long enteredFrames_ = 0;                              // since then
    double clock_ = 0.0, step_ = 0.0;                     // seconds: own, never backwards; of the last frame
    std::optional<double> lastNow_;
    double lastUp_ = -1e9;
    int speculativeFrames_ = 0;  // left of such a trial
    static constexpr double kSpeculativeWait = 2.0;
    double speculativeWait_ = kSpeculativeWait,
           speculativeAfter_ = kSpeculativeWait;  // seconds, own clock: when what is dear but unsure may be tried
    std::vector<Plan> drawn_;                     // as last decided
    std::optional<Plan> refined_;                 // with the samples of a frame: what may have been drawn instead
    ViewClass drawnView_;
    std::optional<ExpectedErrors> errors_;  // in that view
};

}  // namespace dioptre
