// builtin:toys: a playroom, seen from a child's height. What is far is large, so that the view is full at every depth.
#include <array>

#include "scene/builtin/toys.hpp"

namespace dioptre::builtin {

namespace {

const vec3 kToLight{1.0f, 0.8f, 0.25f};
constexpr float kWallX = 5.2f, kWallZ = -15.0f, kWallHeight = 6.5f;

/// Where a toy stands, how large and which way it faces.
mat4 stand(float x, float z, float scale, float degrees, float y = 0.0f) {
    return translation({x, y, z}) * rotation(degrees, kY) * scaling(scale);
}

vec3 rugColor(const vec2& xz, const vec3& below) {
    const vec2 q = (xz - vec2(0.35f, -2.9f)) / vec2(1.35f, 1.1f);
    const float r = glm::length(q);
    if (r > 1.0f) return below;
    const std::array<std::uint32_t, 5> rings{0xd9c7a3, 0x3f6f8f, 0xe6b455, 0xb5463c, 0xd9c7a3};
    const float weave = 0.8f + 0.2f * noise({xz.x * 260.0f, xz.y * 260.0f, 0});
    const float wobble = 0.02f * std::sin(18.0f * std::atan2(q.y, q.x));
    const auto ring = static_cast<std::size_t>(std::min(4.99f, (r + (r > 0.3f ? wobble : 0.0f)) * 5.0f));
    return srgb(rings[ring]) * weave;
}

void addRoom(Model& model) {
    const auto floor = [](const vec2& xz) { return rugColor(xz, floorBoard(xz)); };
    const std::array<Ground, 3> grounds{Ground{{-1.4f, -2.2f}, {1.4f, 0.3f}, 1024},
                                        Ground{{-2.9f, -5.0f}, {2.9f, -2.2f}, 1024},
                                        Ground{{-kWallX, kWallZ}, {kWallX, -5.0f}, 1024}};
    for (const Ground& ground : grounds)
        model.place("floor", addGround(model, "floor", ground, kToLight, 0.45f, 0.72f, floor), mat4(1.0f), false);

    const int wallPicture = model.picture("wallpaper", 1024, 1024, [](float u, float v) {
        // 3.25 m x 6.5 m of wall: stripes, stars, wainscot
        const float x = u * 3.25f, y = (1.0f - v) * kWallHeight;
        const bool pale = fraction(x / 0.65f) < 0.5f;
        vec3 color = srgb(pale ? 0x9cc3d1 : 0x86b3c6);
        const vec2 cell(fraction(x / 0.65f * 2.0f) - 0.5f, fraction(y / 0.65f * 2.0f + (pale ? 0.5f : 0.0f)) - 0.5f);
        const float star = 0.13f * (1.0f + 0.35f * std::cos(5.0f * std::atan2(cell.x, cell.y)));
        color = glm::mix(color, srgb(0xf3e6b8), spot(glm::length(cell), star, 0.02f));
        if (y < 1.1f) {
            const float panel = std::abs(fraction(x / 0.65f) - 0.5f);
            color = srgb(0xeee5d3) * (panel > 0.42f || y > 0.98f || y < 0.16f ? 1.0f : 0.88f);
            color *= 1.0f - 0.3f * spot(std::abs(panel - 0.42f), 0.008f, 0.004f) -
                     0.3f * spot(std::abs(y - 1.0f), 0.02f, 0.01f);
        }
        return color * (0.97f + 0.03f * noise({u * 200.0f, v * 200.0f, 5}));
    });
    const int wall = model.material("wallpaper", vec3(1.0f), 0.85f, 0.0f, wallPicture);
    const auto walls = [] {
        const auto flat = [](const vec3& corner, const vec3& right, float repeats) {
            return sheet(32, 24, [=](float u, float v) { return corner + u * right - v * kWallHeight * kY; })
                .scaleUv({repeats, 1.0f});
        };
        Shape s = flat({-kWallX, kWallHeight, kWallZ}, 2.0f * kWallX * kX, 2.0f * kWallX / 3.25f);
        s.add(flat({-kWallX, kWallHeight, 0.0f}, kWallZ * kZ, -kWallZ / 3.25f));
        return s.add(flat({kWallX, kWallHeight, kWallZ}, -kWallZ * kZ, -kWallZ / 3.25f));
    };
    model.place("walls", model.mesh("walls", {{wall, walls}}), mat4(1.0f), false);

    // A garland of lamps along the far wall and one side
    const Detail detail = model.detail;
    const auto along = [](float t) {
        const float sag = 0.35f * std::abs(std::sin(t * 6.0f * kPi));
        return vec3(glm::mix(-4.9f, 4.9f, t), 3.6f - sag, kWallZ + 0.35f);
    };
    const std::array<vec3, 3> colors{vec3{14.0f, 8.5f, 3.0f}, {12.0f, 2.6f, 1.6f}, {3.0f, 8.0f, 12.0f}};
    std::vector<Model::Part> garland;
    for (std::size_t c = 0; c < colors.size(); ++c)
        garland.push_back(
            {model.glowing("lamp", colors[c]), [=] {
                 Shape s;
                 for (int k = static_cast<int>(c); k < 42; k += 3)
                     s.add(ball(detail, along((toFloat(k) + 0.5f) / 42.0f) - 0.09f * kY, {0.05f, 0.065f, 0.05f}, 24));
                 return s;
             }});
    garland.push_back({model.material("garland", srgb(0x3b5a3a), 0.7f), [=] {
                           std::vector<vec3> path;
                           for (int k = 0; k <= 120; ++k) path.push_back(along(toFloat(k) / 120.0f));
                           return tube(
                               detail, path, [](float) { return 0.014f; }, 8, 360);
                       }});
    model.place("garland", model.mesh("garland", std::move(garland)), mat4(1.0f));
}

}  // namespace

void makeToys(Model& model) {
    addRoom(model);
    const ToyPictures pictures = addToyPictures(model);
    const int ball = addBall(model), top = addTop(model, pictures), doll = addDoll(model),
              rings = addRingStack(model, pictures);
    const int drum = addDrum(model, pictures), skittle = addSkittle(model, pictures),
              rocket = addRocket(model, pictures);
    const int blocks[] = {addBlock(model, "ABCDEF", 0), addBlock(model, "DFBACE", 1), addBlock(model, "CEADFB", 2)};
    const int die = addDie(model), engine = addLocomotive(model, pictures), robot = addRobot(model, pictures);
    const int logs = addWagon(model, pictures, srgb(0x2f6fb4), true),
              balls = addWagon(model, pictures, srgb(0xd0442e), false);
    const int gears = addGears(model, pictures), knot = addKnot(model, pictures),
              xylophone = addXylophone(model, pictures);
    const int kite = addKite(model, pictures), duck = addDuck(model, pictures), teddy = addTeddy(model, pictures);
    const int horse = addHorse(model, pictures), octopus = addOctopus(model, pictures), car = addCar(model, pictures);
    const int marbles[] = {addMarble(model, srgb(0x2f9ad0)), addMarble(model, srgb(0xd8482f)),
                           addMarble(model, srgb(0x57b04a))};

    // Within an arm's reach
    model.place("skittle", skittle, stand(0.205f, -0.42f, 0.85f, 0.0f));
    model.place("die", die, stand(-0.10f, -0.55f, 1.0f, 25.0f));
    model.place("die 2", die, translation({-0.02f, 0.0f, -0.66f}) * rotation(50.0f, kY));
    model.place("marble", marbles[0], stand(0.07f, -0.52f, 0.8f, 0.0f));
    model.place("marble 2", marbles[1], stand(0.13f, -0.60f, 0.9f, 0.0f));
    model.place("marble 3", marbles[2], stand(0.02f, -0.78f, 1.0f, 0.0f));
    model.place("spinning top", top, stand(0.24f, -0.72f, 0.9f, 20.0f));
    model.place("duck", duck, stand(-0.26f, -0.78f, 0.85f, 35.0f));
    // Up to two metres
    model.place("block", blocks[0], stand(-0.53f, -1.15f, 1.6f, 18.0f));
    model.place("block 2", blocks[1], stand(-0.42f, -1.22f, 1.6f, -12.0f));
    model.place("block 3", blocks[2], stand(-0.48f, -1.19f, 1.6f, 30.0f, 0.096f));
    model.place("ring stack", rings, stand(0.42f, -1.25f, 1.1f, 0.0f));
    model.place("knot", knot, stand(-0.03f, -1.35f, 0.8f, 25.0f));
    model.place("car", car, stand(0.13f, -1.05f, 1.0f, 130.0f));
    model.place("locomotive", engine, stand(-0.28f, -1.75f, 1.15f, 62.0f));
    model.place("wagon", logs, stand(-0.58f, -1.92f, 1.15f, 62.0f));
    model.place("wagon 2", balls, stand(-0.85f, -2.06f, 1.15f, 62.0f));
    model.place("doll", doll, stand(0.30f, -1.85f, 1.3f, 0.0f));
    model.place("doll 2", doll, stand(0.47f, -1.80f, 1.0f, -15.0f));
    model.place("doll 3", doll, stand(0.60f, -1.74f, 0.72f, -25.0f));
    // Two to six metres
    model.place("teddy", teddy, stand(0.95f, -2.6f, 1.75f, -28.0f));
    model.place("xylophone", xylophone, stand(0.15f, -2.5f, 1.5f, 15.0f));
    model.place("drum", drum, stand(-0.55f, -2.9f, 1.9f, 10.0f));
    model.place("robot", robot, stand(-1.35f, -3.3f, 2.1f, 25.0f));
    model.place("octopus", octopus, stand(0.45f, -3.5f, 1.9f, -10.0f));
    model.place("ball", ball, stand(1.75f, -4.2f, 2.6f, 40.0f));
    model.place("rocking horse", horse, stand(-0.35f, -4.7f, 2.2f, 65.0f));
    model.place("gears", gears, stand(1.0f, -5.4f, 2.2f, -12.0f));
    // And beyond
    const std::array<vec2, 6> pins{vec2{0, 0},     {-0.3f, -0.5f}, {0.3f, -0.5f},
                                   {-0.6f, -1.0f}, {0, -1.0f},     {0.6f, -1.0f}};
    for (const vec2& pin : pins) model.place("skittle", skittle, stand(-2.3f + pin.x, -6.2f + pin.y, 2.8f, 0.0f));
    model.place("rocket", rocket, stand(2.4f, -7.4f, 4.2f, -20.0f));
    model.place("teddy 2", teddy, stand(0.1f, -8.6f, 4.6f, 8.0f));
    model.place("block 4", blocks[1], stand(-3.6f, -9.6f, 15.0f, 25.0f));
    model.place("block 5", blocks[2], stand(-2.6f, -10.6f, 15.0f, -8.0f));
    model.place("block 6", blocks[0], stand(-3.2f, -10.1f, 15.0f, 12.0f, 0.9f));
    model.place("ring stack 2", rings, stand(3.4f, -11.0f, 8.0f, 0.0f));
    model.place("ball 2", ball, stand(1.5f, -12.4f, 5.5f, 100.0f));
    model.place("robot 2", robot, stand(-0.9f, -13.2f, 6.0f, 5.0f));
    model.place("duck 2", duck, stand(4.2f, -13.6f, 9.0f, -40.0f));
    model.place("kite", kite, stand(-1.1f, -8.2f, 1.9f, 12.0f, 2.2f) * rotation(-14.0f, kZ));
    model.place("kite 2", kite, stand(2.6f, -12.6f, 2.4f, -15.0f, 3.3f) * rotation(18.0f, kZ));

    model.camera({0.0f, 0.34f, 0.0f}, {0.0f, 0.06f, -2.0f});
    model.light(directional("window", kToLight, vec3(2.5f, 2.35f, 2.1f)));
    model.light(pointLight("ceiling lamp", {-2.0f, 4.2f, -8.0f}, vec3(9.0f, 7.6f, 5.6f)));
    model.light(pointLight("floor lamp", {1.6f, 1.4f, 0.4f}, vec3(1.6f, 1.6f, 1.7f)));
}

}  // namespace dioptre::builtin
