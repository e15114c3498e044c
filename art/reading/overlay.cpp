// art/reading/overlay.cpp: draws the kolam that was read over its photograph.
#include "art/reading/kolam_fixes.h"
#include "art/reading/kolam_lines.h"
#include "art/reading/photograph.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace sikku {
namespace {

constexpr glm::dvec3 dot_colour(255, 255, 255);
constexpr std::array<glm::dvec3, 3> state_colours = {{{40, 130, 255}, {30, 200, 80}, {235, 60, 220}}};
constexpr glm::dvec3 doubt_colour(255, 120, 0);
constexpr glm::dvec3 repair_colour(255, 225, 0);

/// Draws on a picture, with smooth edges.
class Canvas {
public:
    explicit Canvas(DecodedPicture& picture) : picture_(picture) {}

    void line(glm::dvec2 from, glm::dvec2 to, double width, glm::dvec3 colour, double opacity = 1) {
        const double reach = 0.5 * width + 1;
        each_near(
            glm::min(from, to) - reach, glm::max(from, to) + reach,
            [&](glm::dvec2 at) {
                const glm::dvec2 way = to - from;
                const double along =
                    std::clamp(glm::dot(at - from, way) / std::max(glm::dot(way, way), 1e-9), 0.0, 1.0);
                return opacity * std::clamp(0.5 * width + 0.5 - glm::distance(at, from + along * way), 0.0, 1.0);
            },
            colour);
    }
    void ring(glm::dvec2 centre, double radius, double width, glm::dvec3 colour) {
        const double reach = radius + width + 1;
        each_near(
            centre - reach, centre + reach,
            [&](glm::dvec2 at) {
                return std::clamp(0.5 * width + 0.5 - std::fabs(glm::distance(at, centre) - radius), 0.0, 1.0);
            },
            colour);
    }
    /// Draws a ring of eight arcs.
    void broken_ring(glm::dvec2 centre, double radius, double width, glm::dvec3 colour) {
        constexpr int points = 48;
        for (int i = 0; i < points; ++i) {
            if (i % 6 > 2) continue;
            const auto at = [&](int k) {
                const double angle = 2 * std::numbers::pi * k / points;
                return centre + radius * glm::dvec2(std::cos(angle), std::sin(angle));
            };
            line(at(i), at(i + 1), width, colour);
        }
    }
    /// Draws digits and commas, 3 x 5 cells each, on a dark ground.
    void number(std::string_view text, glm::dvec2 at, double cell, glm::dvec3 colour) {
        static constexpr std::array<std::uint16_t, 10> digits = {075557, 026227, 071747, 071717, 055711,
                                                                 074717, 074757, 071111, 075757, 075717};
        const double width = 4 * cell * static_cast<double>(text.size());
        box(at - glm::dvec2(cell), at + glm::dvec2(width, 6 * cell), {20, 20, 20});
        for (const char letter : text) {
            for (int row = 0; row < 5; ++row) {
                for (int column = 0; column < 3; ++column) {
                    const bool is_set =
                        letter == ','
                            ? (column == 1 && row >= 3)
                            : (digits[static_cast<std::size_t>(letter - '0')] >> (3 * (4 - row) + 2 - column) & 1) !=
                                  0;
                    if (!is_set) continue;
                    const glm::dvec2 corner = at + cell * glm::dvec2(column, row);
                    box(corner, corner + glm::dvec2(cell), colour);
                }
            }
            at.x += 4 * cell;
        }
    }

private:
    void box(glm::dvec2 low, glm::dvec2 high, glm::dvec3 colour) {
        each_near(
            low, high,
            [&](glm::dvec2 at) {
                return at.x >= low.x - 0.5 && at.x < high.x - 0.5 && at.y >= low.y - 0.5 && at.y < high.y - 0.5 ? 1.0
                                                                                                                : 0.0;
            },
            colour);
    }
    template <class Cover>
    void each_near(glm::dvec2 low, glm::dvec2 high, Cover&& cover, glm::dvec3 colour) {
        if (!(std::fabs(low.x) + std::fabs(low.y) + std::fabs(high.x) + std::fabs(high.y) < 1e8)) return;
        const int left = std::max(0, static_cast<int>(std::floor(low.x)));
        const int right = std::min(picture_.width - 1, static_cast<int>(std::ceil(high.x)));
        const int top = std::max(0, static_cast<int>(std::floor(low.y)));
        const int bottom = std::min(picture_.height - 1, static_cast<int>(std::ceil(high.y)));
        for (int y = top; y <= bottom; ++y) {
            for (int x = left; x <= right; ++x) {
                const double share = cover(glm::dvec2(x, y));
                if (share <= 0) continue;
                std::uint8_t* pixel =
                    &picture_.pixels[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                                          static_cast<std::size_t>(x))];
                for (int c = 0; c < 3; ++c) {
                    pixel[c] = static_cast<std::uint8_t>(std::lround(pixel[c] * (1 - share) + colour[c] * share));
                }
            }
        }
    }

    DecodedPicture& picture_;
};

/// The strands of a gap, in the plane of the lattice.
std::array<std::array<glm::dvec2, 2>, 2> strands(GapState state, DotLattice lattice, glm::dvec2 middle,
                                                 glm::dvec2 along) {
    // The faces beside a gap are smaller between interlaced dots, where strands cross more steeply.
    const glm::dvec2 aside = glm::dvec2(-along.y, along.x) * (lattice == DotLattice::square ? 1.0 : 0.8);
    const auto at = [&](double x, double y) { return middle + x * along + y * aside; };
    switch (state) {
        case GapState::crossed:
            return {{{at(-0.14, -0.14), at(0.14, 0.14)}, {at(-0.14, 0.14), at(0.14, -0.14)}}};
        case GapState::joined:
            return {{{at(-0.18, 0.13), at(0.18, 0.13)}, {at(-0.18, -0.13), at(0.18, -0.13)}}};
        case GapState::turned:
            break;
    }
    return {{{at(-0.13, -0.18), at(-0.13, 0.18)}, {at(0.13, -0.18), at(0.13, 0.18)}}};
}

constexpr glm::dvec3 open_colour(255, 40, 40);
constexpr glm::dvec3 completed_colour(0, 220, 230);
constexpr glm::dvec3 other_colour(150, 150, 150);

/// The picture, faded behind the drawing.
DecodedPicture faded(const DecodedPicture& picture) {
    DecodedPicture behind = picture;
    for (std::uint8_t& value : behind.pixels) value = static_cast<std::uint8_t>(40 + (value * 2U) / 3U);
    return behind;
}

/// Size of the cells of digits.
double cell_size(double spacing) {
    return std::clamp(std::round(spacing / 28), 1.0, 6.0);
}

void draw_kolam(Canvas& canvas, const Photograph& photograph) {
    const ReadKolam& kolam = photograph.kolam;
    const DotLattice lattice = kolam.grid.lattice();
    const LatticeMap& map = photograph.map;
    const auto spacing_at = [&](GridDot place) { return map.spacing(lattice_point(lattice, place)); };
    const auto bold = [&](GridDot place) { return std::max(2.0, 0.06 * spacing_at(place)); };
    const auto ring_dot = [&](glm::dvec2 at, double spacing, glm::dvec3 colour) {
        canvas.ring(at, 0.1 * spacing, std::max(1.0, 0.03 * spacing), colour);
    };
    for (const GridDot dot : kolam.grid.dots()) ring_dot(map.dot(dot), spacing_at(dot), dot_colour);
    const auto label = [&](GridDot place, glm::dvec3 colour) {
        const DotAddress address = address_of(kolam.grid, place);
        const double spacing = spacing_at(place);
        canvas.number(fmt::format("{},{}", address.row, address.number), map.dot(place) + 0.2 * spacing,
                      cell_size(spacing), colour);
    };
    for (const GridDot place : photograph.completed) {
        canvas.broken_ring(map.dot(place), 0.2 * spacing_at(place), bold(place), completed_colour);
    }
    for (const GridDot place : photograph.open_ends) {
        canvas.ring(map.dot(place), 0.34 * spacing_at(place), bold(place), open_colour);
        label(place, open_colour);
    }
    for (const GridDot place : photograph.missing) {
        canvas.broken_ring(map.dot(place), 0.26 * spacing_at(place), bold(place), open_colour);
        label(place, open_colour);
    }
    const std::vector<GapPlace> places = gap_places(kolam.grid);
    for (std::uint32_t i = 0; i < kolam.states.size(); ++i) {
        const GridGap& gap = kolam.grid.gaps()[i];
        const glm::dvec2 from = lattice_point(lattice, kolam.grid.dots()[gap.from]);
        const glm::dvec2 to = lattice_point(lattice, kolam.grid.dots()[gap.to]);
        const glm::dvec2 middle = 0.5 * (from + to);
        const double spacing = map.spacing(middle);
        const double width = std::max(1.5, 0.05 * spacing);
        for (const auto& strand : strands(kolam.states[i], lattice, middle, to - from)) {
            canvas.line(map(strand[0]), map(strand[1]), width,
                        state_colours[static_cast<std::size_t>(kolam.states[i])]);
        }
        const bool is_repaired = std::binary_search(kolam.repaired.begin(), kolam.repaired.end(), i);
        if (!kolam.is_doubtful(i) && !is_repaired) continue;
        const glm::dvec3 colour = is_repaired ? repair_colour : doubt_colour;
        const glm::dvec2 at = map(middle);
        canvas.ring(at, 0.3 * spacing, std::max(2.0, 0.05 * spacing), colour);
        canvas.number(fmt::format("{},{}", places[i].row, places[i].number),
                      at + glm::dvec2(0.24 * spacing, 0.18 * spacing), cell_size(spacing), colour);
    }
    const double spacing = spacing_at(kolam.grid.dots().front());
    for (const glm::dvec2 dot : photograph.others) ring_dot(dot, spacing, other_colour);
}

void write_png(const DecodedPicture& picture, const std::filesystem::path& path) {
    ImageSpec spec;
    spec.format = "png";
    spec.width = picture.width;
    spec.height = picture.height;
    spec.dpi = 96;
    const auto writer = open_image(path, spec);
    writer->rows(0, picture.height, picture.pixels);
    writer->close();
}

}  // namespace

void write_overlay(const Photograph& photograph, const std::filesystem::path& path) {
    DecodedPicture picture = faded(photograph.picture);
    Canvas canvas(picture);
    draw_kolam(canvas, photograph);
    write_png(picture, path);
}

void write_overlay(const RefusedPicture& refused, const std::filesystem::path& path) {
    DecodedPicture picture = faded(refused.picture);
    Canvas canvas(picture);
    for (const RefusedPicture::Spot& spot : refused.spots) canvas.ring(spot.at, spot.radius + 2, 1.5, other_colour);
    if (refused.best) draw_kolam(canvas, *refused.best);
    write_png(picture, path);
}

}  // namespace sikku
