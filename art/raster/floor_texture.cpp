#include "art/raster/floor_texture.h"

#include "engine/base/chance.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

/// A square of numbers whose edges meet.
class Field {
public:
    explicit Field(int bits) : bits_(bits), values_(std::size_t{1} << (2 * bits)) {}
    int bits() const { return bits_; }
    int side() const { return 1 << bits_; }
    float& at(int x, int y) { return values_[index(x, y)]; }
    float at(int x, int y) const { return values_[index(x, y)]; }
    std::vector<float>& values() { return values_; }
    const std::vector<float>& values() const { return values_; }

private:
    std::size_t index(int x, int y) const {
        const int mask = side() - 1;
        return (static_cast<std::size_t>(y & mask) << bits_) + static_cast<std::size_t>(x & mask);
    }
    int bits_;
    std::vector<float> values_;
};

float chance_of(std::uint64_t seed, std::uint64_t number) {
    return static_cast<float>(scrambled(seed + 0x9E3779B97F4A7C15U * (number + 1)) >> 40) * 0x1p-23f - 1;
}

/// Adds smooth noise, a cubic B-spline over random numbers, of `across` by `down` waves.
void add_noise(Field& field, std::uint64_t seed, int across, int down, float amplitude) {
    const int side = field.side();
    const auto weights = [](float t) {
        const float u = 1 - t;
        return std::array<float, 4>{u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                                    (3 * u * u * u - 6 * u * u + 4) / 6, t * t * t / 6};
    };
    // First along rows, then along columns.
    const auto n = static_cast<std::size_t>(side);
    std::vector<float> rows(static_cast<std::size_t>(down) * n);
    const auto each = [&](int cells, auto&& put) {
        for (int i = 0; i < side; ++i) {
            const float place = static_cast<float>(i) * static_cast<float>(cells) / static_cast<float>(side);
            const int knot = static_cast<int>(place);
            put(i, knot, weights(place - static_cast<float>(knot)));
        }
    };
    for (int row = 0; row < down; ++row) {
        each(across, [&](int i, int knot, const std::array<float, 4>& w) {
            float sum = 0;
            for (int k = 0; k < 4; ++k) {
                const auto number = static_cast<std::uint64_t>(row * across + (knot + k) % across);
                sum += w[static_cast<std::size_t>(k)] * chance_of(seed, number);
            }
            rows[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(i)] = sum;
        });
    }
    each(down, [&](int i, int knot, const std::array<float, 4>& w) {
        float* out = &field.at(0, i);
        for (int k = 0; k < 4; ++k) {
            const float* row = &rows[static_cast<std::size_t>((knot + k) % down) * n];
            const float weight = amplitude * w[static_cast<std::size_t>(k)];
            for (std::size_t x = 0; x < n; ++x) out[x] += weight * row[x];
        }
    });
}

/// Noise of several sizes, each half of the one before. @param fall  amplitude of each relative to the one before
void add_octaves(Field& field, std::uint64_t seed, int waves, int count, float amplitude, float fall) {
    for (int k = 0; k < count && waves <= field.side() / 2; ++k, waves *= 2, amplitude *= fall) {
        add_noise(field, seed + static_cast<std::uint64_t>(k), waves, waves, amplitude);
    }
}

/// Adds discs with soft edges. @param least, most  radius in texels
void add_specks(Field& field, std::uint64_t seed, int count, float least, float most, float amplitude) {
    const auto side = static_cast<float>(field.side());
    for (int number = 0; number < count; ++number) {
        const auto chance = [&](std::uint64_t channel) {
            return (chance_of(seed, 4 * static_cast<std::uint64_t>(number) + channel) + 1) / 2;
        };
        const float x = side * chance(0), y = side * chance(1), size = chance(2);
        const float radius = least + (most - least) * size * size * size;
        const float peak = amplitude * (0.3f + 0.7f * chance(3));
        const int reach = static_cast<int>(radius) + 1;
        for (int row = -reach; row <= reach; ++row) {
            for (int column = -reach; column <= reach; ++column) {
                const int at_x = static_cast<int>(x) + column, at_y = static_cast<int>(y) + row;
                const float dx = static_cast<float>(at_x) + 0.5f - x, dy = static_cast<float>(at_y) + 0.5f - y;
                const float inside = 1 - (dx * dx + dy * dy) / (radius * radius);
                if (inside > 0) field.at(at_x, at_y) += peak * std::min(1.0f, 2 * inside);
            }
        }
    }
}

/// Adds short straight lines, as of straw. @param length, width  in texels
void add_straws(Field& field, std::uint64_t seed, int count, float length, float width, float amplitude) {
    const auto side = static_cast<float>(field.side());
    for (int number = 0; number < count; ++number) {
        const auto chance = [&](std::uint64_t channel) {
            return chance_of(seed, 8 * static_cast<std::uint64_t>(number) + channel);
        };
        const float x = side * (chance(0) + 1) / 2, y = side * (chance(1) + 1) / 2;
        float ux = chance(2), uy = chance(3);
        const float norm = std::sqrt(ux * ux + uy * uy);
        if (norm < 0.1f) continue;
        ux /= norm, uy /= norm;
        const float half = length * (0.6f + 0.4f * chance(4)) / 2, thick = width * (0.75f + 0.25f * chance(5)) / 2;
        const float peak = amplitude * (0.6f + 0.4f * chance(6));
        const int reach = static_cast<int>(half + thick) + 1;
        for (int row = -reach; row <= reach; ++row) {
            for (int column = -reach; column <= reach; ++column) {
                const auto dx = static_cast<float>(column), dy = static_cast<float>(row);
                const float along = std::fabs(dx * ux + dy * uy), aside = std::fabs(dy * ux - dx * uy);
                if (along > half || aside > thick) continue;
                field.at(static_cast<int>(x) + column, static_cast<int>(y) + row) += peak * (1 - aside / thick / 2);
            }
        }
    }
}

/// Wipes of a hand, a broom or a trowel: arcs of streaks, each over those before.
/// @param radius, breadth  of an arc, in texels  @param streak  distance of streaks in texels
void add_wipes(Field& field, std::uint64_t seed, int count, float radius, float breadth, float streak,
               float amplitude) {
    const auto side = static_cast<float>(field.side());
    std::vector<float> wiped(field.values().size(), 0.0f);
    for (int number = 0; number < count; ++number) {
        const std::uint64_t own = scrambled(seed + static_cast<std::uint64_t>(number));
        const float x = side * (chance_of(own, 0) + 1) / 2, y = side * (chance_of(own, 1) + 1) / 2;
        float ux = chance_of(own, 2), uy = chance_of(own, 3);
        const float norm = std::sqrt(ux * ux + uy * uy);
        if (norm < 0.1f) continue;
        ux /= norm, uy /= norm;
        // The arc runs through (x, y), its centre lies in the direction u, and it spans a sixth of a turn or so.
        const float around = radius * (1 + 0.4f * chance_of(own, 4)), half = breadth * (1 + 0.3f * chance_of(own, 5));
        const float span = 0.55f * around;
        const int reach = static_cast<int>(span + half) + 1;
        for (int row = -reach; row <= reach; ++row) {
            for (int column = -reach; column <= reach; ++column) {
                const auto dx = static_cast<float>(column), dy = static_cast<float>(row);
                const float cx = dx - around * ux, cy = dy - around * uy;
                const float off = std::sqrt(cx * cx + cy * cy) - around;
                const float along = dx * uy - dy * ux;
                const float a = 1 - off * off / (half * half), b = 1 - along * along / (span * span);
                if (a <= 0 || b <= 0) continue;
                const float place = (off + half) / streak;
                const auto knot = static_cast<std::uint64_t>(place);
                const float t = place - static_cast<float>(knot), s = t * t * (3 - 2 * t);
                const float height =
                    (1 - s) * chance_of(own, 16 + knot) + s * chance_of(own, 17 + knot) + 0.5f * off / half;
                const float opaque = std::min(1.0f, 2.5f * a) * std::min(1.0f, 2 * b) * 0.85f;
                const int at_x = static_cast<int>(x) + column, at_y = static_cast<int>(y) + row;
                const int mask = field.side() - 1;
                float& old = wiped[(static_cast<std::size_t>(at_y & mask) << field.bits()) +
                                   static_cast<std::size_t>(at_x & mask)];
                old += opaque * (height - old);
            }
        }
    }
    for (std::size_t i = 0; i < wiped.size(); ++i) field.values()[i] += amplitude * wiped[i];
}

/// Layers of a cleft stone: heights in steps where `broken` is above 0. @param step  height of a step
void cleave(Field& field, const Field& broken, float step) {
    for (std::size_t i = 0; i < field.values().size(); ++i) {
        float& value = field.values()[i];
        const float level = std::floor(value / step), rest = value / step - level;
        const float edge = rest < 0.88f ? 0.35f * rest : 0.308f + (rest - 0.88f) * 5.77f;
        const float share = std::clamp(4 * broken.values()[i] + 0.2f, 0.0f, 1.0f);
        value += share * ((level + edge) * step - value);
    }
}

/// The light from the upper left on the heights of a field. @param relief  share of the heights themselves that stays
Field lit(const Field& field, float slope, float relief) {
    Field result(field.bits());
    for (int y = 0; y < field.side(); ++y) {
        for (int x = 0; x < field.side(); ++x) {
            const float rise = 2 * field.at(x, y) - field.at(x + 1, y) - field.at(x, y + 1);
            result.at(x, y) = relief * field.at(x, y) - slope * std::clamp(rise, -0.5f, 0.5f);
        }
    }
    return result;
}

/// Adds a field, scaled to a standard deviation.
void add_scaled(Field& to, const Field& from, float deviation) {
    double sum = 0, squares = 0;
    for (const float value : from.values()) {
        sum += static_cast<double>(value);
        squares += static_cast<double>(value) * static_cast<double>(value);
    }
    const double count = static_cast<double>(from.values().size()), mean = sum / count;
    const double spread = std::sqrt(std::max(squares / count - mean * mean, 1e-12));
    const auto scale = static_cast<float>(static_cast<double>(deviation) / spread), middle = static_cast<float>(mean);
    for (std::size_t i = 0; i < to.values().size(); ++i) to.values()[i] += scale * (from.values()[i] - middle);
}

/// Heights as bytes with a standard deviation of 32 around 128, and all smaller sizes down to 8 texels.
FloorLayer layer_of(const Field& field, double texel) {
    Field scaled(field.bits());
    add_scaled(scaled, field, 32);
    FloorLayer layer{field.bits(), texel, {}};
    std::vector<float> values = scaled.values();
    for (int side = field.side(); side >= 8; side /= 2) {
        std::vector<std::uint8_t> bytes(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            bytes[i] = static_cast<std::uint8_t>(std::clamp(values[i] + 128.5f, 0.0f, 255.0f));
        }
        layer.level.push_back(std::move(bytes));
        const auto half = static_cast<std::size_t>(side / 2), whole = static_cast<std::size_t>(side);
        std::vector<float> smaller(half * half);
        for (std::size_t y = 0; y < half; ++y) {
            for (std::size_t x = 0; x < half; ++x) {
                const float* upper = &values[2 * y * whole + 2 * x];
                smaller[y * half + x] = (upper[0] + upper[1] + upper[whole] + upper[whole + 1]) / 4;
            }
        }
        values = std::move(smaller);
    }
    return layer;
}

constexpr int grain_bits = 9, mark_bits = 10, stain_bits = 8;
constexpr double grain_texel = 0.06, mark_texel = 0.28, stain_texel = 4.0;

/// The fields of a floor.
struct Fields {
    Field grain{grain_bits}, mark{mark_bits}, stain{stain_bits};
};

Fields red_earth() {
    Fields f;
    add_octaves(f.grain, 11, 64, 3, 1, 0.9f);
    add_specks(f.grain, 12, 2600, 1.2f, 5, 0.9f);
    add_specks(f.grain, 13, 1300, 1.2f, 4.5f, -0.9f);
    Field height(mark_bits), wipes(mark_bits);
    add_octaves(height, 14, 8, 6, 1, 0.72f);
    add_wipes(wipes, 15, 90, 420, 90, 5, 1);
    add_scaled(f.mark, lit(height, 3, 0.8f), 1);
    add_scaled(f.mark, wipes, 0.55f);
    add_specks(f.mark, 16, 700, 1, 3, 2.2f);
    add_specks(f.mark, 17, 900, 1, 3, -2);
    add_octaves(f.stain, 18, 7, 4, 1, 0.7f);
    return f;
}

Fields cow_dung() {
    Fields f;
    add_octaves(f.grain, 21, 48, 3, 1, 0.8f);
    add_straws(f.grain, 22, 1500, 26, 2.4f, 1.1f);
    add_straws(f.grain, 23, 1200, 22, 2.2f, -1);
    Field height(mark_bits), wipes(mark_bits);
    add_octaves(height, 24, 10, 6, 1, 0.75f);
    add_wipes(wipes, 25, 110, 330, 110, 6.5f, 1);
    add_scaled(f.mark, lit(height, 2.5f, 0.5f), 0.6f);
    add_scaled(f.mark, wipes, 0.85f);
    add_straws(f.mark, 26, 1500, 15, 1.7f, 1.9f);
    add_straws(f.mark, 27, 900, 12, 1.7f, -1.6f);
    add_octaves(f.stain, 28, 9, 4, 1, 0.75f);
    return f;
}

Fields slate() {
    Fields f;
    Field flakes(grain_bits);
    add_octaves(flakes, 31, 10, 5, 1, 0.7f);
    f.grain = lit(flakes, 4, 0.3f);
    Field height(mark_bits), broken(mark_bits);
    add_noise(height, 32, 3, 5, 2.2f);
    add_octaves(height, 33, 7, 6, 1, 0.6f);
    add_octaves(broken, 36, 11, 3, 1, 0.8f);
    cleave(height, broken, 0.5f);
    add_octaves(height, 37, 128, 2, 0.07f, 0.7f);
    add_scaled(f.mark, lit(height, 6, 0.16f), 1);
    add_octaves(f.stain, 38, 5, 5, 1, 0.75f);
    return f;
}

Fields concrete() {
    Fields f;
    add_octaves(f.grain, 41, 64, 3, 1, 0.9f);
    add_specks(f.grain, 42, 1500, 1, 6, -1.1f);
    Field height(mark_bits), wipes(mark_bits);
    add_octaves(height, 43, 6, 7, 1, 0.7f);
    add_wipes(wipes, 44, 60, 700, 130, 8, 1);
    add_scaled(f.mark, lit(height, 2, 0.9f), 1);
    add_scaled(f.mark, wipes, 0.3f);
    add_specks(f.mark, 45, 420, 0.8f, 4.5f, -3.2f);
    add_specks(f.mark, 46, 900, 0.8f, 2, 1.6f);
    add_octaves(f.stain, 47, 6, 5, 1, 0.8f);
    return f;
}

/// How a floor looks: shares of sand and marks, and the colours where stains are weak, of the mean, and strong.
struct Look {
    Fields (*fields)();
    int grain_share, mark_share;
    float contrast;  ///< by which the lightest and the darkest shade differ from the middle, as a share of the colour
    glm::vec3 weak, strong;  ///< added to the mean colour, for stains of two deviations
};

Look look_of(Floor floor) {
    switch (floor) {
        case Floor::red_earth:
            return {red_earth, 46, 70, 0.34f, {8, 4, 3}, {-7, -4, -3}};
        case Floor::cow_dung:
            return {cow_dung, 44, 72, 0.4f, {7, 5, 0}, {-6, -3, -2}};
        case Floor::slate:
            return {slate, 56, 88, 0.62f, {-3, 0, 4}, {6, 1, -4}};
        case Floor::concrete:
            break;
    }
    return {concrete, 44, 60, 0.32f, {5, 5, 6}, {-6, -6, -7}};
}

/// The colour of a shade on a stain: lighter and darker by the contrast, and redder in the dark.
glm::vec3 shaded(const Look& look, glm::vec3 mean, int tint, int shade) {
    const float stain = std::clamp((static_cast<float>(8 * tint + 4) - 128) / 64, -2.0f, 2.0f);
    const glm::vec3 colour = mean + (stain < 0 ? -stain * look.weak : stain * look.strong);
    return colour * (1 + look.contrast * static_cast<float>(shade - 128) / 64);
}

std::uint32_t packed(glm::vec3 colour) {
    std::uint32_t bytes = 0;
    for (int channel = 0; channel < 3; ++channel) {
        const auto value = static_cast<std::uint32_t>(std::clamp(colour[channel] + 0.5f, 0.0f, 255.0f));
        bytes |= value << (8 * channel);
    }
    return bytes;
}

/// Sets the colours so that their mean over the floor is that of the floor.
void set_colours(FloorTexture& texture, const Look& look, Colour mean) {
    const auto set = [&](glm::vec3 middle) {
        for (int tint = 0; tint < FloorTexture::tints; ++tint) {
            for (int shade = 0; shade < 256; ++shade) {
                texture.colours[static_cast<std::size_t>(256 * tint + shade)] =
                    packed(shaded(look, middle, tint, shade));
            }
        }
    };
    const glm::vec3 wanted(mean.red, mean.green, mean.blue);
    set(wanted);
    constexpr std::uint64_t samples = 40'000;
    std::array<std::uint64_t, 3> sums{};
    for (std::uint64_t i = 0; i < samples; ++i) {
        const auto texel = [&](std::size_t layer) {
            const std::vector<std::uint8_t>& bytes = texture.layers[layer].level.front();
            return static_cast<int>(bytes[scrambled(3 * i + layer) % bytes.size()]);
        };
        const std::uint32_t colour = texture.colour(texel(0), texel(1), texel(2));
        for (std::size_t channel = 0; channel < 3; ++channel) sums[channel] += (colour >> (8 * channel)) & 255;
    }
    glm::vec3 found;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        found[static_cast<int>(channel)] = static_cast<float>(sums[channel]) / static_cast<float>(samples);
    }
    set(wanted + wanted - found);
}

FloorTexture made_texture(Floor floor) {
    const Look look = look_of(floor);
    const Fields fields = look.fields();
    FloorTexture texture;
    texture.layers = {layer_of(fields.grain, grain_texel), layer_of(fields.mark, mark_texel),
                      layer_of(fields.stain, stain_texel)};
    texture.grain_share = look.grain_share;
    texture.mark_share = look.mark_share;
    set_colours(texture, look, mean_colour(floor));
    return texture;
}

}  // namespace

const FloorTexture& floor_texture(Floor floor) {
    switch (floor) {
        case Floor::red_earth: {
            static const FloorTexture texture = made_texture(Floor::red_earth);
            return texture;
        }
        case Floor::cow_dung: {
            static const FloorTexture texture = made_texture(Floor::cow_dung);
            return texture;
        }
        case Floor::slate: {
            static const FloorTexture texture = made_texture(Floor::slate);
            return texture;
        }
        case Floor::concrete:
            break;
    }
    static const FloorTexture texture = made_texture(Floor::concrete);
    return texture;
}

}  // namespace sikku
