// Families of models about materials, textures and vertex data.
#include "families.hpp"

namespace dioptre::test {
namespace {

glm::dvec3 rgb(const glm::dvec4& c) {
    return glm::dvec3(c);
}

/// Linear between the corners of the two triangles that the planes consist of: lower right, upper left.
template <class T>
T betweenCorners(glm::dvec2 at, const T& lowerLeft, const T& lowerRight, const T& upperLeft, const T& upperRight) {
    const double u = at.x + 0.5, v = at.y + 0.5;
    if (v <= u) return lowerLeft * (1.0 - u) + lowerRight * (u - v) + upperRight * v;
    return lowerLeft * (1.0 - v) + upperLeft * (v - u) + upperRight * u;
}

const glm::dvec3 kRed(1, 0, 0), kGreen(0, 1, 0), kBlue(0, 0, 1), kYellow(1, 1, 0);

/// The README's pictures are worth a mean of pixels against one of the texels under them.
constexpr double kFiltered = 0.08;

double spread(const Image& image) {
    const glm::dvec3 mean = meanColor(image, 60, 60, 240, 240);
    double sum = 0.0;
    for (int y = 60; y < 240; ++y)
        for (int x = 60; x < 240; ++x) sum += std::pow(pixelAt(image, x, y).y - mean.y, 2.0);
    return std::sqrt(sum) / 180.0;
}

}  // namespace

void checkInterleaved(const std::string& name) {
    const Scene scene = unlit(loadModel(name));
    const Image picture = drawModel(scene);
    expectPlane(
        picture,
        [&](glm::dvec2 at) {
            return rgb(texels(scene.images[0], uvAt(at))) * betweenCorners(at, kRed, kGreen, kYellow, kBlue);
        },
        0.01);
    // Bytes and shorts say the same as floats.
    expectSame(picture, drawModel(unlit(loadModel("Buffer_Interleaved_00"))), "as floats");
    expectSame(drawModel(loadModel(name)), drawModel(loadModel("Buffer_Interleaved_00")), "as floats, lit");
}

void checkAlphaBlend(const std::string& name) {
    const int number = numberOf(name);
    const bool colored = number == 0 || number == 3 || number == 4 || number == 6;
    const bool textured = number == 1 || number == 3 || number >= 5;
    const double factor = number == 2 || number >= 4 ? 0.7 : 1.0;
    const Scene scene = unlit(loadModel(name));
    const Image onBlack = drawModel(scene), onWhiteWall = drawModel(onWhite(scene));
    const auto base = [&](glm::dvec2 at) {
        glm::dvec4 color(1.0, 1.0, 1.0, factor);
        if (textured) color *= texels(scene.images[0], uvAt(at));
        const auto grey = [](double alpha) { return glm::dvec4(0.3, 0.3, 0.3, alpha); };
        if (colored) color *= betweenCorners(at, grey(0.2), grey(0.4), grey(0.8), grey(0.6));
        return color;
    };
    // What is lost of the white behind is the opacity.
    expectPlane([&](glm::dvec2 at) { return seenAt(onWhiteWall, at) - seenAt(onBlack, at); },
                [&](glm::dvec2 at) { return glm::dvec3(1.0 - base(at).a); }, kFiltered);
    expectPlane(
        onBlack, [&](glm::dvec2 at) { return rgb(base(at)) * base(at).a; }, kFiltered);
}

void checkAlphaMask(const std::string& name) {
    constexpr double kCutoffs[] = {0.5, 0.4, 0.7, 1.1, 0.0, 0.4, 0.6};
    const int number = numberOf(name);
    const double cutoff = kCutoffs[number], factor = number >= 5 ? 0.7 : 1.0;
    const Scene scene = unlit(loadModel(name));
    const Image picture = drawModel(onWhite(scene));
    expectPlane(
        picture,
        [&](glm::dvec2 at) -> std::optional<glm::dvec3> {
            // Only where the texture is not about to cross the cut-off.
            const double near = texels(scene.images[0], uvAt(at)).a, exact = texels(scene.images[0], uvAt(at), 0.0).a;
            if (std::abs(near - exact) > 0.02 || std::abs(near * factor - cutoff) < 0.03) return std::nullopt;
            if (near * factor < cutoff) return glm::dvec3(1.0);
            return rgb(texels(scene.images[0], uvAt(at)));
        },
        kFiltered);
    if (number == 3) {
        EXPECT_EQ(pixelsDrawn(drawModel(scene)), 0);
    }
    if (number == 4) {
        EXPECT_NEAR(pixelsDrawn(drawModel(scene)), 200 * 200, 500);
    }
}

void checkMaterial(const std::string& name) {
    const int number = numberOf(name);
    const bool bumpy = number == 1 || number == 4 || number == 7;
    const double occlusion = number == 2 ? 1.0 : number == 5 || number == 7 ? 0.5 : 0.0;
    const bool emits = number == 3 || number >= 6, emissionTexture = number >= 6;
    const Scene scene = loadModel(name);
    const auto textureOf = [&](const TextureSlot& slot) { return scene.images[static_cast<std::size_t>(slot.image)]; };
    const auto emission = [&](glm::dvec2 at) {
        if (!emits) return glm::dvec3(0.0);
        return emissionTexture ? rgb(texels(textureOf(scene.materials[0].emissiveTexture), uvAt(at))) : glm::dvec3(1.0);
    };
    // The same without what the README lists: under the sky all else is a factor or a term on top of it.
    Scene bare = scene;
    bare.materials[0].occlusionTexture = bare.materials[0].emissiveTexture = {};
    bare.materials[0].emissive = glm::vec3(0.0f);
    const Image picture = drawModel(underSky(scene)), without = drawModel(underSky(bare));
    expectPlane(
        picture,
        [&](glm::dvec2 at) {
            double open = 1.0;
            if (occlusion > 0.0)
                open =
                    1.0 +
                    occlusion *
                        (texels(textureOf(scene.materials[0].occlusionTexture), uvAt(at), kPatchSize, false).r - 1.0);
            return seenAt(without, at) * open + emission(at);
        },
        kFiltered);
    // Occlusion leaves a lamp's light alone.
    const Image lamp = drawModel(underSky(scene, 3.0f)), bareLamp = drawModel(underSky(bare, 3.0f));
    expectPlane([&](glm::dvec2 at) { return seenAt(lamp, at) - seenAt(picture, at); },
                [&](glm::dvec2 at) { return seenAt(bareLamp, at) - seenAt(without, at); }, 0.005);

    // Bumps are bright where they face a lamp from the right, and from above.
    for (const glm::dvec3 toLamp : {glm::dvec3(1, 0, 1), glm::dvec3(0, 1, 1)}) {
        const Image lit = drawModel(underSky(bare, 3.0f, glm::vec3(-toLamp)));
        if (!bumpy) {
            EXPECT_LT(spread(lit), 0.002);
            continue;
        }
        EXPECT_GT(spread(lit), 0.01);
        const TextureImage normals = textureOf(scene.materials[0].normalTexture);
        const double scale = number == 1 ? 1.0 : 10.0;
        glm::dvec3 sums(0.0);  // of products: with itself, and with the picture
        for (double y = -0.45; y < 0.46; y += 0.02)
            for (double x = -0.45; x < 0.46; x += 0.02) {
                glm::dvec3 n = rgb(texels(normals, uvAt({x, y}), 0.0, false)) * 2.0 - 1.0;
                n = glm::normalize(n * glm::dvec3(scale, scale, 1.0));
                const double facing = std::max(glm::dot(n, glm::normalize(toLamp)), 0.0) - 0.5;
                const double seen = seenAt(lit, {x, y}).y - meanColor(lit, 60, 60, 240, 240).y;
                sums += glm::dvec3(facing * facing, facing * seen, seen * seen);
            }
        EXPECT_GT(sums.y / std::sqrt(sums.x * sums.z), 0.7) << "correlation of slope and light";
    }
}

void checkPrimitivesUv(const std::string& name) {
    // First set of the left and the right triangle, then the second set of each
    constexpr bool kSets[9][4] = {
        {false, false, false, false}, {true, false, false, false}, {false, true, false, false},
        {true, true, false, false},   {true, false, true, false},  {false, true, false, true},
        {true, true, false, true},    {true, true, true, false},   {true, true, true, true}};
    const bool(&sets)[4] = kSets[numberOf(name)];
    const Scene scene = unlit(loadModel(name));
    expectPlane(
        drawModel(scene),
        [&](glm::dvec2 at) -> std::optional<glm::dvec3> {
            if (std::abs(at.x - at.y) < 0.02) return std::nullopt;
            const bool right = at.y < at.x;
            if (!sets[right] && !sets[2 + right]) return glm::dvec3(1.0);
            const glm::dvec2 uv = sets[2 + right] ? glm::dvec2(0.5, 0.0) + 0.5 * uvAt(at) : uvAt(at);
            const double size = sets[2 + right] ? 0.5 * kPatchSize : kPatchSize;
            const glm::dvec3 vertex = betweenCorners(at, kGreen, kRed, kBlue, right ? kBlue : kRed);
            return rgb(texels(scene.images[0], uv, size)) * vertex;
        },
        kFiltered);
}

namespace {

enum class Edge { repeat, clamp, mirror };

/// A texture coordinate as its wrap mode has it, 0..1.
double wrapped(double x, Edge edge) {
    if (edge == Edge::clamp) return std::clamp(x, 0.0, 1.0);
    if (edge == Edge::mirror && (x < 0.0 || x > 1.0)) return x < 0.0 ? -x : 2.0 - x;
    return x - std::floor(x);
}

struct Wraps {
    Edge s = Edge::repeat, t = Edge::repeat;
};

/// Mean of the texels under a square of the plane, `size` metres wide; these models' coordinates go from -0.3 to 1.3.
glm::dvec3 under(const TextureImage& image, const Wraps& wraps, glm::dvec2 at, double size) {
    constexpr int kSteps = 24;
    glm::dvec3 sum(0.0);
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
            const glm::dvec2 p = at + size * (glm::dvec2(i + 0.5, j + 0.5) / double(kSteps) - 0.5);
            const glm::dvec2 uv(wrapped(0.5 + 1.6 * p.x, wraps.s), wrapped(0.5 - 1.6 * p.y, wraps.t));
            sum += rgb(texels(image, glm::min(uv, 0.9999), 0.0));
        }
    return sum / double(kSteps * kSteps);
}

// Of all ways to wrap it is the one wanted that explains the picture.
void expectWraps(const Scene& scene, const Wraps& wanted) {
    const Image picture = drawModel(scene);
    const auto off = [&](const Wraps& wraps) {
        double sum = 0.0;
        int count = 0;
        for (double y = -0.46; y < 0.47; y += 0.0575)
            for (double x = -0.46; x < 0.47; x += 0.0575, ++count)
                sum += glm::length(seenAt(picture, {x, y}) - under(scene.images[0], wraps, {x, y}, kPatchSize));
        return sum / count;
    };
    const double least = off(wanted);
    EXPECT_LT(least, 0.08);
    for (const Edge s : {Edge::repeat, Edge::clamp, Edge::mirror})
        for (const Edge t : {Edge::repeat, Edge::clamp, Edge::mirror}) {
            if (s == wanted.s && t == wanted.t) continue;
            EXPECT_GT(off({s, t}), 1.5 * least) << "wrapped as " << static_cast<int>(s) << ", " << static_cast<int>(t);
        }
}

// Close by, 10 pixels to a texel: squares, or they run into one another.
void expectMagnification(const Scene& scene, double texel, bool nearest) {
    View close = frontView(kSide * texel / 10.0);
    close.pose.position += glm::dvec3(0.2, 0.13, 0.0);
    const Image picture = drawModel(scene, close);
    int steps = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 1; x < kSide; ++x) steps += pixelAt(picture, x, y) != pixelAt(picture, x - 1, y);
    if (nearest) {
        EXPECT_LE(steps, kSide * kSide / 9) << "a row changes from texel to texel only";
    } else {
        EXPECT_GE(steps, kSide * kSide / 3) << "a row changes all the way";
    }
}

// Far away, 20 texels to a pixel: without mipmaps single texels flicker, with them a pixel is the mean of its texels.
void expectMinification(const Scene& scene, double texel, const Wraps& wraps, bool mipmapped) {
    const double pixel = 20.0 * texel;
    const Image picture = drawModel(scene, frontView(kSide * pixel));
    const int side = static_cast<int>(1.0 / 1.6 / pixel);  // not where the texture begins again
    const int first = (kSide - side) / 2 + 2, last = (kSide + side) / 2 - 2;
    // Mipmaps were seen to be 0.02 to 0.045 off, by their filters; none 0.065 to 0.08.
    constexpr double kFlicker = 0.055;
    double off = 0.0;
    for (int y = first; y < last; ++y)
        for (int x = first; x < last; ++x) {
            const glm::dvec2 at = glm::dvec2(x + 0.5 - kSide / 2.0, kSide / 2.0 - y - 0.5) * pixel;
            off += glm::length(pixelAt(picture, x, y) - under(scene.images[0], wraps, at, pixel));
        }
    off /= std::pow(last - first, 2.0);
    if (mipmapped) {
        EXPECT_LT(off, kFlicker) << "mean distance from the mean of a pixel's texels";
    } else {
        EXPECT_GT(off, kFlicker) << "single texels come closer to the mean than they can";
    }
}

}  // namespace

void checkSampler(const std::string& name) {
    const int number = numberOf(name);
    const Scene scene = unlit(loadModel(name));
    Wraps wraps;
    if (number == 3 || number == 13) wraps.s = Edge::clamp;
    if (number == 4) wraps.s = Edge::mirror;
    if (number == 1 || number == 13) wraps.t = Edge::clamp;
    if (number == 2) wraps.t = Edge::mirror;
    const bool mipmapped = number != 7 && number != 8 && number != 13;
    expectWraps(scene, wraps);
    const double texel = 1.0 / (1.6 * scene.images[0].width);  // metres
    expectMagnification(scene, texel, number == 5 || number == 13);
    expectMinification(scene, texel, wraps, mipmapped);
    if (number < 9 || number > 11) return;
    const View far = frontView(kSide * texel * 20.0);
    EXPECT_GT(worstDifference(drawModel(scene, far), drawModel(unlit(loadModel("Texture_Sampler_12")), far)).mean,
              0.0002)
        << "as if linear between texels and levels";
}

}  // namespace dioptre::test
