#include "tests/photograph_maker.h"

namespace sikku {

void draw_lines(FlatKolam& flat, const MadePhotograph& made, const DotGrid& grid, const GapStates& states,
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

FlatKolam draw_flat(const MadePhotograph& made, PictureChance& chance) {
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

void write_photograph(const MadePhotograph& made, const std::filesystem::path& path) {
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
