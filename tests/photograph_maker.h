// tests/photograph_maker.h: pictures of kolams that look like photographs, with what they show known.
#pragma once

#include "art/image/image_file.h"
#include "art/kolam/dot_grid_making.h"
#include "art/reading/kolam_lines.h"
#include "art/reading/lattice.h"
#include "engine/base/chance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace sikku {

/// How a picture is distorted. 1 is moderate: a tilt of about 20 degrees, light that falls off by half.
struct Distortion {
    double tilt = 1;
    double light = 1;
    double texture = 1;
    double blur = 1;
    double noise = 1;
    double breaks = 1;  ///< of lines
    double wobble = 1;  ///< of the hand
};

/// A kolam beside the others of a picture.
struct OtherKolam {
    DotGrid grid;
    GapStates states;
    glm::dvec2 at{0.0};  ///< its middle, in spacings from that of the first
};

struct MadePhotograph {
    DotGrid grid;
    GapStates states;
    bool light_lines = true;
    double line_width = 0.1;  ///< spacings
    double dot_radius = 0.07;
    int width = 1200;
    int height = 900;
    double turn = 0;  ///< degrees
    std::uint32_t seed = 1;
    Distortion distortion = {};
    std::vector<std::uint32_t> lost = {};                        ///< dots that are not drawn
    std::vector<std::uint32_t> large = {};                       ///< dots as flowers, which nearly fill their loops
    std::vector<std::pair<glm::dvec2, glm::dvec2>> petals = {};  ///< leaves without dots, from tip to tip
    double bend = 0;                                             ///< of rows and columns, in spacings
    glm::dvec2 beside{0.0};  ///< dots from the middles of their loops, in spacings
    std::vector<OtherKolam> others = {};
};

/// Numbers that are the same with every standard library.
class PictureChance {
public:
    explicit PictureChance(std::uint32_t seed) : engine_(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
    }
    double normal() { return uniform(-1, 1) + uniform(-1, 1) + uniform(-1, 1); }

private:
    std::mt19937 engine_;
};

/// The kolam from above, one number a pixel: 0 ground, 1 ink. `scale` pixels a spacing, `margin` spacings around it.
struct FlatKolam {
    int width = 0, height = 0;
    double scale = 48, margin = 1.2;
    glm::dvec2 low{0.0}, high{0.0};
    std::vector<float> ink;

    glm::dvec2 pixel(glm::dvec2 place) const { return {(place.x - low.x) * scale, (high.y - place.y) * scale}; }
    double at(glm::dvec2 place) const {
        const glm::dvec2 p = pixel(place);
        const auto x = static_cast<int>(std::floor(p.x));
        const auto y = static_cast<int>(std::floor(p.y));
        if (x < 0 || y < 0 || x + 1 >= width || y + 1 >= height) return 0;
        const double u = p.x - x;
        const double v = p.y - y;
        const auto value = [&](int i, int j) {
            return static_cast<double>(
                ink[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)]);
        };
        return (value(x, y) * (1 - u) + value(x + 1, y) * u) * (1 - v) +
               (value(x, y + 1) * (1 - u) + value(x + 1, y + 1) * u) * v;
    }
    void disc(glm::dvec2 place, double radius, double strength) {
        const glm::dvec2 p = pixel(place);
        const double r = radius * scale;
        for (int y = static_cast<int>(p.y - r - 1); y <= static_cast<int>(p.y + r + 1); ++y) {
            for (int x = static_cast<int>(p.x - r - 1); x <= static_cast<int>(p.x + r + 1); ++x) {
                if (x < 0 || y < 0 || x >= width || y >= height) continue;
                const double cover = std::clamp(r + 0.5 - glm::distance(p, glm::dvec2(x, y)), 0.0, 1.0) * strength;
                float& value =
                    ink[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
                value = std::max(value, static_cast<float>(cover));
            }
        }
    }
};

/// A disc that moves along a line, whose width varies, and which fails here and there, as powder does.
class FlatPen {
public:
    FlatPen(FlatKolam& flat, const MadePhotograph& made, PictureChance& chance)
        : flat_(flat),
          made_(made),
          chance_(chance),
          until_break_(chance.uniform(1, 6)),
          phase_(chance.uniform(0, 6.28), chance.uniform(0, 6.28)) {}
    void move(glm::dvec2 place, double step) {
        along_ += step;
        place += 0.015 * made_.distortion.wobble *
                 glm::dvec2(std::sin(2.3 * along_ + phase_.x) + std::sin(5.1 * along_),
                            std::sin(2.9 * along_ + phase_.y) + std::sin(4.3 * along_));
        until_break_ -= step;
        if (until_break_ < 0) {
            in_break_ = made_.distortion.breaks * chance_.uniform(0.03, 0.14);
            until_break_ = chance_.uniform(2, 8);
        }
        in_break_ -= step;
        const double width = made_.line_width * (1 + 0.18 * std::sin(3.7 * along_));
        if (in_break_ <= 0) flat_.disc(bent(made_, place), width / 2, 1);
    }
    /// The position of a place in rows that are bent.
    static glm::dvec2 bent(const MadePhotograph& made, glm::dvec2 place) {
        return place + made.bend * glm::dvec2(std::sin(1.1 * place.y + 1), std::sin(0.9 * place.x));
    }

private:
    FlatKolam& flat_;
    const MadePhotograph& made_;
    PictureChance& chance_;
    double until_break_;
    double in_break_ = 0;
    double along_ = 0;
    glm::dvec2 phase_;
};

inline void draw_lines(FlatKolam& flat, const MadePhotograph& made, const DotGrid& grid, const GapStates& states,
                       glm::dvec2 at, PictureChance& chance) {
    for (const ClosedLine& line : lines_of_kolam(grid, states, 0.0)) {
        // A uniform cubic B-spline along the sides of dots.
        const std::size_t count = line.size();
        const auto control = [&](std::size_t i) {
            const glm::dvec2 p = line[i % count];
            return at + glm::dvec2(0.5 * p.x, lattice_point(grid.lattice(), {0, 1}).y * p.y);
        };
        FlatPen pen(flat, made, chance);
        for (std::size_t i = 0; i < count; ++i) {
            constexpr int pieces = 24;
            for (int k = 0; k < pieces; ++k) {
                const double t = static_cast<double>(k) / pieces;
                const double s = 1 - t;
                pen.move((s * s * s * control(i) + (3 * t * t * t - 6 * t * t + 4) * control(i + 1) +
                          (3 * s * s * s - 6 * s * s + 4) * control(i + 2) + t * t * t * control(i + 3)) /
                             6.0,
                         0.7 / pieces);
            }
        }
    }
}

inline FlatKolam draw_flat(const MadePhotograph& made, PictureChance& chance) {
    FlatKolam flat;
    const DotLattice lattice = made.grid.lattice();
    flat.low = flat.high = lattice_point(lattice, made.grid.dots()[0]);
    const auto include = [&](glm::dvec2 place) {
        flat.low = glm::min(flat.low, place);
        flat.high = glm::max(flat.high, place);
    };
    for (const GridDot dot : made.grid.dots()) include(lattice_point(lattice, dot));
    for (const OtherKolam& other : made.others) {
        for (const GridDot dot : other.grid.dots()) include(other.at + lattice_point(other.grid.lattice(), dot));
    }
    for (const auto& petal : made.petals) include(petal.second);
    flat.low -= flat.margin;
    flat.high += flat.margin;
    flat.width = static_cast<int>((flat.high.x - flat.low.x) * flat.scale) + 1;
    flat.height = static_cast<int>((flat.high.y - flat.low.y) * flat.scale) + 1;
    flat.ink.resize(static_cast<std::size_t>(flat.width) * static_cast<std::size_t>(flat.height));
    const auto draw_dot = [&](glm::dvec2 place, double radius) {
        const glm::dvec2 off(chance.normal(), chance.normal());
        flat.disc(FlatPen::bent(made, place + made.beside + 0.012 * made.distortion.wobble * off),
                  radius * chance.uniform(0.85, 1.15), 1);
    };
    for (std::uint32_t i = 0; i < made.grid.dots().size(); ++i) {
        if (std::count(made.lost.begin(), made.lost.end(), i) > 0) continue;
        const bool is_large = std::count(made.large.begin(), made.large.end(), i) > 0;
        draw_dot(lattice_point(lattice, made.grid.dots()[i]), is_large ? 0.19 : made.dot_radius);
    }
    draw_lines(flat, made, made.grid, made.states, glm::dvec2(0.0), chance);
    for (const OtherKolam& other : made.others) {
        for (const GridDot dot : other.grid.dots()) {
            draw_dot(other.at + lattice_point(other.grid.lattice(), dot), made.dot_radius);
        }
        draw_lines(flat, made, other.grid, other.states, other.at, chance);
    }
    for (const auto& [from, to] : made.petals) {
        const glm::dvec2 way = to - from;
        const glm::dvec2 aside(-way.y, way.x);
        for (const double sign : {-1.0, 1.0}) {
            FlatPen pen(flat, made, chance);
            for (int k = 0; k <= 60; ++k) {
                const double t = k / 60.0;
                pen.move(from + t * way + sign * 0.28 * std::sin(std::numbers::pi * t) * aside,
                         glm::length(way) / 60);
            }
        }
    }
    return flat;
}

/// Uneven values of several sizes, about -1 to 1.
class Texture {
public:
    Texture(int width, int height, PictureChance& chance) : width_(width), height_(height) {
        for (const double size : {90.0, 31.0, 11.0, 4.0}) {
            Layer layer{size, static_cast<int>(width / size) + 3, {}};
            layer.values.resize(static_cast<std::size_t>(layer.columns) *
                                static_cast<std::size_t>(static_cast<int>(height / size) + 3));
            for (double& value : layer.values) value = chance.uniform(-1, 1);
            layers_.push_back(std::move(layer));
        }
    }
    double at(int x, int y) const {
        double sum = 0;
        for (const Layer& layer : layers_) {
            const double u = x / layer.size;
            const double v = y / layer.size;
            const auto i = static_cast<std::size_t>(u);
            const auto j = static_cast<std::size_t>(v);
            const double a = u - static_cast<double>(i);
            const double b = v - static_cast<double>(j);
            const auto columns = static_cast<std::size_t>(layer.columns);
            const double* at = &layer.values[j * columns + i];
            sum += (at[0] * (1 - a) + at[1] * a) * (1 - b) + (at[columns] * (1 - a) + at[columns + 1] * a) * b;
        }
        return sum / 2;
    }

private:
    struct Layer {
        double size;
        int columns;
        std::vector<double> values;
    };
    int width_, height_;
    std::vector<Layer> layers_;
};

/// Writes the picture as JPEG.
inline void write_photograph(const MadePhotograph& made, const std::filesystem::path& path) {
    PictureChance chance(made.seed);
    const FlatKolam flat = draw_flat(made, chance);
    const Distortion& d = made.distortion;
    // Where the corners of the flat kolam come to lie, all of them in the picture.
    const double turn = made.turn * std::numbers::pi / 180;
    const double tilt_x = d.tilt * chance.uniform(-0.22, 0.22);
    const double tilt_y = d.tilt * chance.uniform(-0.22, 0.22);
    const double squeeze = 1 - d.tilt * chance.uniform(0.02, 0.14);
    const glm::dvec2 half = 0.5 * (flat.high - flat.low);
    const glm::dvec2 middle = 0.5 * (flat.high + flat.low);
    std::vector<glm::dvec2> from;
    std::vector<glm::dvec2> to;
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
        const glm::dvec2 place = corner * half;
        glm::dvec2 seen(place.x * std::cos(turn) - place.y * std::sin(turn),
                        -(place.x * std::sin(turn) + place.y * std::cos(turn)));
        seen.y *= squeeze;
        const double depth = 1 + tilt_x * seen.x / half.x + tilt_y * seen.y / half.y;
        from.push_back(seen / depth);
        to.push_back(middle + place);
        low = glm::min(low, from.back());
        high = glm::max(high, from.back());
    }
    const double fill = chance.uniform(0.88, 0.98);
    const double size = fill * std::min(made.width / (high.x - low.x), made.height / (high.y - low.y));
    for (glm::dvec2& point : from) {
        point = glm::dvec2(made.width, made.height) / 2.0 + size * (point - 0.5 * (low + high));
    }
    const Homography back = *Homography::fit(from, to);
    const Texture texture(made.width, made.height, chance);
    const double ground = made.light_lines ? chance.uniform(70, 110) : chance.uniform(190, 225);
    const double ink = made.light_lines ? chance.uniform(190, 235) : chance.uniform(40, 80);
    const double light_angle = chance.uniform(0, 6.28);
    const glm::dvec2 light(std::cos(light_angle), std::sin(light_angle));
    std::vector<float> grey(static_cast<std::size_t>(made.width) * static_cast<std::size_t>(made.height));
    for (int y = 0; y < made.height; ++y) {
        for (int x = 0; x < made.width; ++x) {
            const double covered = flat.at(back({x, y}));
            const double rough = texture.at(x, y);
            const double base = ground * (1 + 0.16 * d.texture * rough);
            // Powder thins where the ground is rough.
            const double powder = std::clamp(covered * (1 - 0.25 * d.texture * std::max(0.0, rough)), 0.0, 1.0);
            const double value = base + (ink - base) * powder;
            const double away = glm::dot(glm::dvec2(x - made.width / 2.0, y - made.height / 2.0), light) / made.width;
            grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(made.width) + static_cast<std::size_t>(x)] =
                static_cast<float>(value * (1 + 0.7 * d.light * away));
        }
    }
    // Blur over squares, twice.
    const int radius = static_cast<int>(std::lround(d.blur * chance.uniform(0.6, 1.6)));
    std::vector<float> other(grey.size());
    for (int pass = 0; pass < 2 && radius > 0; ++pass) {
        for (const bool down : {false, true}) {
            const int lines = down ? made.width : made.height;
            const int length = down ? made.height : made.width;
            const auto index = [&](int line, int i) {
                i = std::clamp(i, 0, length - 1);
                return down ? static_cast<std::size_t>(i) * static_cast<std::size_t>(made.width) +
                                  static_cast<std::size_t>(line)
                            : static_cast<std::size_t>(line) * static_cast<std::size_t>(made.width) +
                                  static_cast<std::size_t>(i);
            };
            for (int line = 0; line < lines; ++line) {
                for (int i = 0; i < length; ++i) {
                    float sum = 0;
                    for (int k = -radius; k <= radius; ++k) sum += grey[index(line, i + k)];
                    other[index(line, i)] = sum / static_cast<float>(2 * radius + 1);
                }
            }
            std::swap(grey, other);
        }
    }
    std::vector<std::uint8_t> pixels;
    pixels.reserve(3 * grey.size());
    const glm::dvec3 tint = made.light_lines ? glm::dvec3(1.08, 0.98, 0.9) : glm::dvec3(1.0, 0.99, 0.95);
    for (const float value : grey) {
        const double noisy = value + 5 * d.noise * chance.normal();
        for (int c = 0; c < 3; ++c) {
            pixels.push_back(static_cast<std::uint8_t>(std::clamp(noisy * tint[c], 0.0, 255.0)));
        }
    }
    ImageSpec spec;
    spec.format = "jpg";
    spec.width = made.width;
    spec.height = made.height;
    const auto writer = open_image(path, spec);
    writer->rows(0, made.height, pixels);
    writer->close();
}

}  // namespace sikku
