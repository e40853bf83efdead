#include "focus/gaze_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "focus/stereo_rig.hpp"

namespace dioptre {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

View headView() {
    View view;
    view.frustum = symmetricFrustum(Radians(0.8), 2.0);
    view.width = 400;
    view.height = 200;
    return view;
}

/// A square facing the head at its own vergence.
struct Card {
    double x0, x1, y0, y1;  // as tangents seen from the head's centre
    double vergence;
};

/// What `view` (an eye of a head at the origin, looking along -z) sees of the cards before a wall.
std::vector<float> drawVergence(const View& view, const PixelRegion& region, const std::vector<Card>& cards,
                                double wall) {
    std::vector<float> picture;
    const Frustum& f = view.frustum;
    for (int row = region.y; row < region.y + region.height; ++row) {
        for (int column = region.x; column < region.x + region.width; ++column) {
            const double tx = f.left + (column + 0.5) / view.width * (f.right - f.left);
            const double ty = f.top - (row + 0.5) / view.height * (f.top - f.bottom);
            double nearest = wall;
            for (const Card& card : cards) {
                const double middleX = tx + view.pose.position.x * card.vergence;  // the same point, seen by the head
                if (middleX >= card.x0 && middleX < card.x1 && ty >= card.y0 && ty < card.y1)
                    nearest = std::max(nearest, card.vergence);
            }
            picture.push_back(static_cast<float>(nearest));
        }
    }
    return picture;
}

/// Draws both eyes' regions around the gaze and asks.
std::optional<Dioptres> look(Metres ipd, const std::vector<Card>& cards, double wall, glm::dvec2 gaze, double sigma,
                             const std::optional<ScreenGeometry>& screen = std::nullopt) {
    const View centre = eyeView(Eye::centre, headView(), ipd, screen);
    std::vector<std::vector<float>> pictures;
    std::vector<EyeVergence> eyes;
    for (const Eye eye : {Eye::left, Eye::right}) {
        const View view = eyeView(eye, headView(), ipd, screen);
        const MidpointShift shift = midpointShift(view, centre);
        const PixelRegion region = gazeRegion(view, shift, gaze, glm::dvec2(sigma));
        pictures.push_back(drawVergence(view, region, cards, wall));
        eyes.push_back({pictures.back(), region, shift});
    }
    return gazeVergence(eyes, gaze, glm::dvec2(sigma));
}

glm::dvec2 pixelAt(const View& view, double tx, double ty) {
    const Frustum& f = view.frustum;
    return {(tx - f.left) / (f.right - f.left) * view.width, (f.top - ty) / (f.top - f.bottom) * view.height};
}

TEST(GazeDepthTest, LeftEyeSeesNearThingsShiftedRight) {
    const View head = headView();
    const Metres ipd(0.063);
    const double expected = focalLengthPixels(head).x * 0.0315;
    const MidpointShift left = midpointShift(eyeView(Eye::left, head, ipd), head);
    const MidpointShift right = midpointShift(eyeView(Eye::right, head, ipd), head);
    EXPECT_NEAR(left.pixelsPerDioptre, -expected, 1e-12);  // from the left picture to the midpoint: to the left
    EXPECT_NEAR(right.pixelsPerDioptre, expected, 1e-12);
    EXPECT_EQ(left.pixels, 0.0);
    const MidpointShift none = midpointShift(eyeView(Eye::left, head, Metres(0.0)), head);
    EXPECT_EQ(none.pixelsPerDioptre, 0.0);
    EXPECT_EQ(none.pixels, 0.0);
}

TEST(GazeDepthTest, ShiftVanishesInTheScreensPlane) {
    const ScreenGeometry screen{Metres(0.6), Metres(0.8)};
    const View centre = eyeView(Eye::centre, headView(), Metres(0.063), screen);
    for (const Eye eye : {Eye::left, Eye::right}) {
        const MidpointShift shift = midpointShift(eyeView(eye, headView(), Metres(0.063), screen), centre);
        EXPECT_NE(shift.pixels, 0.0);
        EXPECT_NEAR(shift.pixelsPerDioptre / 0.8 + shift.pixels, 0.0, 1e-9);
    }
}

TEST(GazeDepthTest, FindsACardWhereTheMidpointSeesIt) {
    const std::vector<Card> cards = {{-0.1, 0.1, -0.1, 0.1, 3.0}};
    for (const double ipd : {0.0, 0.063, 0.2}) {
        for (const auto& screen :
             {std::optional<ScreenGeometry>(), std::optional(ScreenGeometry{Metres(0.6), Metres(0.8)})}) {
            const View centre = eyeView(Eye::centre, headView(), Metres(ipd), screen);
            const auto at = [&](double x, double y) {
                return look(Metres(ipd), cards, 0.5, pixelAt(centre, x, y), 4.0, screen);
            };
            SCOPED_TRACE(::testing::Message() << "ipd " << ipd << " screen " << screen.has_value());
            ASSERT_TRUE(at(0.0, 0.0));
            EXPECT_EQ(at(0.0, 0.0)->value, 3.0);
            EXPECT_EQ(at(0.08, 0.0)->value, 3.0);
            EXPECT_EQ(at(-0.08, -0.08)->value, 3.0);
            EXPECT_EQ(at(0.2, 0.0)->value, 0.5);
            EXPECT_EQ(at(-0.2, 0.0)->value, 0.5);
            EXPECT_EQ(at(0.0, 0.15)->value, 0.5);
        }
    }
}

// A thing narrower than the parallax: each eye sees the wall "through" it, at the very place where the midpoint sees
// it.
TEST(GazeDepthTest, SmallNearThingHidesTheWallBehindIt) {
    const std::vector<Card> cards = {{-0.05, 0.05, -0.2, 0.2, 5.0}};
    const View head = headView();
    EXPECT_GT(focalLengthPixels(head).x * 0.0315 * 4.5, 10.0);  // parallax beyond the card's half width and the cone
    for (const double x : {-0.03, 0.0, 0.03}) {
        const auto found = look(Metres(0.063), cards, 0.5, pixelAt(head, x, 0.0), 4.0);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->value, 5.0) << x;
    }
}

TEST(GazeDepthTest, MedianAtAnEdgePicksASideNeverBetween) {
    const std::vector<Card> cards = {{-1.0, 0.0, -1.0, 1.0, 4.0}};
    const View head = headView();
    int changes = 0;
    double last = 4.0;
    for (double x = -0.05; x <= 0.05; x += 0.002) {
        const auto found = look(Metres(0.063), cards, 1.0, pixelAt(head, x, 0.01), 4.0);
        ASSERT_TRUE(found);
        EXPECT_TRUE(found->value == 4.0 || found->value == 1.0) << x << ": " << found->value;
        changes += found->value != last;
        last = found->value;
    }
    EXPECT_EQ(changes, 1);
    EXPECT_EQ(last, 1.0);
}

/// Upright bars at one depth, so wide and so far apart in the midpoint's pixels; the first is around the middle.
std::vector<Card> bars(double width, double period, double vergence, int each) {
    const double pixel = 1.0 / focalLengthPixels(headView()).x;
    std::vector<Card> cards;
    for (int i = -each; i <= each; ++i) {
        const double x = i * period;
        cards.push_back({(x - 0.5 * width) * pixel, (x + 0.5 * width) * pixel, -1.0, 1.0, vergence});
    }
    return cards;
}

// A pole of so much of the cone's area, at once in the middle of the gaze: sigma 4 px, cut at 8 px.
TEST(GazeDepthTest, APoleIsLookedPastUntilItFillsHalfOfTheCone) {
    const View head = headView();
    // The middle 5 px of such a cone hold half of its weight.
    for (const double vergence : {1.5, 3.0, 6.0})
        for (const double wall : {0.0, 0.2})
            for (const double width : {1.0, 2.0, 3.5, 7.5, 12.0}) {
                const auto found =
                    look(Metres(0.063), bars(width, 0.0, vergence, 0), wall, pixelAt(head, 0.0, 0.0), 4.0);
                ASSERT_TRUE(found);
                EXPECT_EQ(found->value, static_cast<double>(static_cast<float>(width < 5.0 ? wall : vergence)))
                    << width << " px at " << vergence << " D";
            }
}

// A fence: how much of the cone it fills decides, not where it happens to stand, nor how far apart the eyes see it.
TEST(GazeDepthTest, AFenceIsLookedThroughUntilItFillsHalfOfTheCone) {
    const View head = headView();
    struct Fence {
        double width, period;
    };
    for (const double ipd : {0.0, 0.063})
        for (const double vergence : {2.0, 5.0})
            for (const Fence fence : {Fence{1.0, 4.0}, {2.0, 8.0}, {2.0, 5.0}, {3.0, 8.0}, {5.0, 8.0}, {6.0, 8.0}})
                for (double x = 0.0; x < fence.period; x += 0.4) {
                    const glm::dvec2 gaze = pixelAt(head, 0.0, 0.0) + glm::dvec2(x, 0.0);
                    const auto found =
                        look(Metres(ipd), bars(fence.width, fence.period, vergence, 30), 0.25, gaze, 6.0);
                    ASSERT_TRUE(found);
                    EXPECT_EQ(found->value, fence.width / fence.period < 0.5 ? 0.25 : vergence)
                        << fence.width << " of " << fence.period << " px at " << vergence << " D, ipd " << ipd
                        << ", gaze " << x;
                }
}

// None of three fills half of the cone: from the middle one both others blur least.
TEST(GazeDepthTest, OfThreeDepthsTheMiddleOneBlursLeast) {
    const View head = headView();
    const double pixel = 1.0 / focalLengthPixels(head).x;
    const std::vector<Card> cards = {{-1.0, -1.0 * pixel, -1.0, 1.0, 4.0}, {-1.0 * pixel, 1.0 * pixel, -1.0, 1.0, 1.0}};
    const auto found = look(Metres(0.0), cards, 0.25, pixelAt(head, 0.0, 0.0), 4.0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->value, 1.0);
}

TEST(GazeDepthTest, SlantedSurfaceGivesItsMiddle) {
    const MidpointShift shift{12.0, 0.0};
    std::vector<float> picture;
    for (int row = 0; row < 60; ++row)
        for (int column = 0; column < 60; ++column) picture.push_back(1.0f + 0.02f * static_cast<float>(column));
    const EyeVergence eye{picture, {0, 0, 60, 60}, shift};
    // x_mid = (column + 0.5) + 12 (1 + 0.02 column): the gaze at 46 falls on column 27
    const auto found = gazeVergence({&eye, 1}, {12.5 + 27.0 * 1.24, 30.0}, glm::dvec2(5.0));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->value, 1.0 + 0.02 * 27.0, 0.021);
}

TEST(GazeDepthTest, SkyIsAValueAndNonsenseIsSkipped) {
    const std::vector<float> sky(100, 0.0f), broken(100, kNan);
    std::vector<float> mixed(100, kNan);
    mixed[55] = 2.0f;
    mixed[54] = -1.0f;
    mixed[56] = std::numeric_limits<float>::infinity();
    const auto ask = [](const std::vector<float>& picture) {
        const EyeVergence eye{picture, {0, 0, 10, 10}, {}};
        return gazeVergence({&eye, 1}, {5.0, 5.0}, glm::dvec2(2.0));
    };
    ASSERT_TRUE(ask(sky));
    EXPECT_EQ(ask(sky)->value, 0.0);
    EXPECT_FALSE(ask(broken));
    ASSERT_TRUE(ask(mixed));
    EXPECT_EQ(ask(mixed)->value, 2.0);
}

TEST(GazeDepthTest, OutsideAndNoArgumentsGiveNothing) {
    const std::vector<float> picture(100, 1.0f);
    const EyeVergence eye{picture, {0, 0, 10, 10}, {}};
    EXPECT_FALSE(gazeVergence({}, {5.0, 5.0}, glm::dvec2(2.0)));
    EXPECT_FALSE(gazeVergence({&eye, 1}, {50.0, 5.0}, glm::dvec2(2.0)));
    EXPECT_FALSE(gazeVergence({&eye, 1}, {std::nan(""), 5.0}, glm::dvec2(2.0)));
    EXPECT_FALSE(gazeVergence({&eye, 1}, {5.0, 5.0}, glm::dvec2(std::nan(""))));
    // No cone at all still is the pixel under the gaze.
    EXPECT_TRUE(gazeVergence({&eye, 1}, {5.0, 5.0}, glm::dvec2(0.0)));
    EXPECT_TRUE(gazeVergence({&eye, 1}, {5.0, 5.0}, glm::dvec2(std::numeric_limits<double>::infinity())));
}

TEST(GazeDepthTest, RegionIsWithinThePictureAndReachesSidewaysWhereTheEyeDoes) {
    const View head = headView();
    const View left = eyeView(Eye::left, head, Metres(0.063));
    const MidpointShift shift = midpointShift(left, head);
    const double reach = -shift.pixelsPerDioptre * 10.0;
    const PixelRegion region = gazeRegion(left, shift, {50.0, 100.0}, {3.0, 2.0}, Dioptres(10.0));
    EXPECT_EQ(region.x, 44);
    EXPECT_EQ(region.x + region.width, static_cast<int>(std::ceil(56.0 + reach)));
    EXPECT_EQ(region.y, 96);
    EXPECT_EQ(region.height, 8);
    const PixelRegion clipped = gazeRegion(left, shift, {399.0, 1.0}, {3.0, 3.0});
    EXPECT_EQ(clipped.x + clipped.width, 400);
    EXPECT_EQ(clipped.y, 0);
    EXPECT_TRUE(gazeRegion(left, shift, {50.0, -100.0}, {3.0, 3.0}).empty());
    EXPECT_TRUE(gazeRegion(left, shift, {std::nan(""), 0.0}, {3.0, 3.0}).empty());
    EXPECT_TRUE(gazeRegion(left, shift, {1e300, 0.0}, {3.0, 3.0}).empty());
}

TEST(GazeDepthTest, ConeInPixels) {
    const View head = headView();
    const glm::dvec2 sigma = coneSigmaPixels(head, Radians(0.01));
    EXPECT_NEAR(sigma.y, focalLengthPixels(head).y * std::tan(0.01), 1e-12);
}

}  // namespace
}  // namespace dioptre
