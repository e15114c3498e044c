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

void draw_lines(FlatKolam& flat, const MadePhotograph& made, const DotGrid& grid, const GapStates& states,
                glm::dvec2 at, PictureChance& chance);

FlatKolam draw_flat(const MadePhotograph& made, PictureChance& chance);

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
void write_photograph(const MadePhotograph& made, const std::filesystem::path& path);

}  // namespace sikku
