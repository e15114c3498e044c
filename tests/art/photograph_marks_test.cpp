// tests/art/photograph_marks_test.cpp: pictures of kolams with lost dots, added marks, or without kolams.
#include "art/kolam/dot_grid_making.h"
#include "art/reading/photograph.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/photograph_maker.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sikku::photograph_marks_test {

MadePhotograph made_of(const std::string& grid, std::uint32_t seed, double level = 0.7) {
    DotGrid dots = parse_dot_grid(grid);
    RandomKolam random{.seed = 40 + seed, .composed = true};
    random.symmetry = usual_symmetries(dots, false).front();
    GapStates states = random_states(dots, random);
    MadePhotograph made{std::move(dots), std::move(states)};
    made.light_lines = seed % 2 == 1;
    made.line_width = 0.08 + 0.02 * (seed % 3);
    made.turn = static_cast<double>(seed * 13 % 21) - 10;
    made.seed = 500 + seed;
    made.distortion = {level, level, level, level, level, level, level};
    return made;
}

Photograph read_made(const MadePhotograph& made, const PhotographOptions& options = {}) {
    const ScratchFolder folder;
    write_photograph(made, folder.path() / "photo.jpg");
    return read_photograph(folder.path() / "photo.jpg", options);
}

std::string notes_of(const Photograph& photograph) {
    std::string text;
    for (const std::string& note : photograph.kolam.notes) text += note + "\n";
    return text;
}

/// The dots of a grid that is read as another one with some of the dots, or places beside them. Grids are compared by
/// the shift that most dots agree with.
std::set<std::pair<int, int>> places_of(const std::vector<GridDot>& places, GridDot shift) {
    std::set<std::pair<int, int>> all;
    for (const GridDot place : places) all.emplace(place.x + shift.x, place.y + shift.y);
    return all;
}
GridDot shift_to(const DotGrid& from, const DotGrid& to) {
    std::map<std::pair<int, int>, int> votes;
    for (const GridDot a : from.dots()) {
        for (const GridDot b : to.dots()) ++votes[{b.x - a.x, b.y - a.y}];
    }
    const auto best = std::max_element(votes.begin(), votes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return {best->first.first, best->first.second};
}

/// Every dot of the truth is read or reported as lost, and no other place is taken for a dot.
void expect_no_silent_loss(const MadePhotograph& made) {
    const Photograph read = read_made(made);
    SCOPED_TRACE(read.kolam.grid.text() + "\n" + notes_of(read));
    const GridDot shift = shift_to(read.kolam.grid, made.grid);
    const auto truth = places_of(made.grid.dots(), {0, 0});
    const auto dots = places_of(read.kolam.grid.dots(), shift);
    auto marked = places_of(read.open_ends, shift);
    marked.merge(places_of(read.missing, shift));
    for (const auto& place : truth) {
        EXPECT_TRUE(dots.contains(place) || marked.contains(place))
            << place.first << "," << place.second << " is lost";
    }
    for (const auto& place : dots)
        EXPECT_TRUE(truth.contains(place)) << place.first << "," << place.second << " is not a dot";
    // Certain gaps between dots that were read are right.
    for (std::uint32_t gap = 0; gap < read.kolam.states.size(); ++gap) {
        if (read.kolam.is_doubtful(gap)) continue;
        const GridGap& each = read.kolam.grid.gaps()[gap];
        const GridDot from = read.kolam.grid.dots()[each.from];
        const auto dot = made.grid.dot_at({from.x + shift.x, from.y + shift.y});
        if (!dot) continue;
        const std::int32_t same = made.grid.gap(*dot, each.side);
        ASSERT_GE(same, 0);
        EXPECT_EQ(read.kolam.states[gap], made.states[static_cast<std::size_t>(same)]) << "gap " << gap;
    }
}

TEST(PhotographMarks, LostDotsAreReadOrReported) {
    struct Case {
        const char* grid;
        std::vector<std::uint32_t> lost;
    };
    const std::vector<Case> cases = {
        {"1-3-5-7-5-3-1", {0}},             // a tip
        {"1-3-5-7-5-3-1", {0, 24, 9, 15}},  // all four
        {"1-3-5-7-5-3-1", {12}},            // the middle
        {"5x5", {0}},                       // a corner
        {"5x5", {2, 22}},                   // of the rim
        {"7x7", {8, 24, 30}},               // inside
        {"9-5 idukku", {3, 30}},
    };
    std::uint32_t seed = 0;
    for (const Case& each : cases) {
        SCOPED_TRACE(fmt::format("{} without {}", each.grid, fmt::format("{}", each.lost.front())));
        MadePhotograph made = made_of(each.grid, ++seed);
        made.lost = each.lost;
        expect_no_silent_loss(made);
    }
}

/// A dot that is a flower nearly fills its loop, which the spot of a dot does not.
TEST(PhotographMarks, FlowersAreDots) {
    for (const std::uint32_t seed : {1U, 2U}) {
        MadePhotograph made = made_of("1-3-5-7-5-3-1", seed, 0.4);
        made.large = {0, 9, 12, 15, 24};
        const Photograph read = read_made(made);
        EXPECT_EQ(read.kolam.grid.text(), made.grid.text()) << notes_of(read);
    }
}

/// No line leads to the corners, which are flowers in rings.
TEST(PhotographMarks, RingsAroundFlowersAreKept) {
    MadePhotograph made = made_of("5x5", 1, 0.4);
    made.states = parse_gap_states(made.grid, "0110 01110 1111 11111 1111 11111 1111 01110 0110");
    made.large = {0, 4, 20, 24};
    expect_no_silent_loss(made);
}

TEST(PhotographMarks, PetalsWithoutDotsAreNotDots) {
    MadePhotograph made = made_of("2-4-6-6-4-2", 3, 0.4);
    for (const glm::dvec2 way : {glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(-1, 0), glm::dvec2(0, -1)}) {
        made.petals.emplace_back(2.8 * way, 4.3 * way);
    }
    const Photograph read = read_made(made);
    EXPECT_EQ(read.kolam.grid.text(), made.grid.text()) << notes_of(read);
}

/// Rows that waver by a seventh of the spacing, and dots beside the middles of their loops.
TEST(PhotographMarks, HandDrawingsMayBeIrregular) {
    for (const std::uint32_t seed : {1U, 2U}) {
        MadePhotograph made = made_of("1-3-5-7-9-7-5-3-1", seed, 0.4);
        made.bend = 0.14;
        expect_no_silent_loss(made);
        made.bend = 0;
        made.beside = {0.12, -0.06};
        expect_no_silent_loss(made);
    }
}

/// A frame of dots and loops around a kolam that no line joins to it, on a lattice of its own or on the same one.
TEST(PhotographMarks, FramesWithDotsAreOtherKolams) {
    std::string frame;
    for (int row = 0; row < 13; ++row) {
        if (row > 0) frame += "/";
        for (int column = 0; column < 13; ++column) {
            frame += row < 2 || row > 10 || column < 2 || column > 10 ? 'o' : '.';
        }
    }
    for (const glm::dvec2 shift : {glm::dvec2(0.0), glm::dvec2(0.4, 0.3)}) {
        MadePhotograph made = made_of("1-3-5-7-5-3-1", 1, 0.4);
        OtherKolam around{parse_dot_grid(frame), {}, shift};
        around.states =
            random_states(around.grid, {.seed = 5, .density = 0.8, .symmetry = GridSymmetry::d4, .composed = true});
        made.others.push_back(around);
        const Photograph read = read_made(made);
        EXPECT_EQ(read.kolam.grid.text(), made.grid.text()) << notes_of(read);
        EXPECT_EQ(read.kolams, 2U);
        EXPECT_TRUE(has(notes_of(read), "2 kolams in the picture: this is number 1"));
        const Photograph second = read_made(made, {.number = 2});
        EXPECT_EQ(second.kolam.grid.dots().size(), around.grid.dots().size());
    }
}

TEST(PhotographMarks, SeveralKolamsAreCountedAndChosen) {
    MadePhotograph made = made_of("5x5", 1, 0.4);
    const std::vector<std::pair<const char*, glm::dvec2>> others = {
        {"1-3-5-3-1", {7.3, 0.2}}, {"3x4", {0.4, -6.7}}, {"1-3-5-7-5-3-1", {7.6, -7.1}}};
    for (const auto& [grid, at] : others) {
        OtherKolam other{parse_dot_grid(grid), {}, at};
        other.states = random_states(other.grid, {.seed = 9, .composed = true});
        made.others.push_back(other);
    }
    made.width = 1400;
    made.height = 1300;
    std::vector<std::string> read;
    for (std::size_t number = 1; number <= 4; ++number) {
        const Photograph photograph = read_made(made, {.number = number});
        EXPECT_EQ(photograph.kolams, 4U);
        EXPECT_TRUE(has(notes_of(photograph), fmt::format("4 kolams in the picture: this is number {}", number)));
        read.push_back(photograph.kolam.grid.text());
    }
    // Those with most dots first; two have 25.
    std::sort(read.begin(), read.begin() + 2);
    EXPECT_EQ(read, (std::vector<std::string>{"1-3-5-7-5-3-1", "5x5", "1-3-5-3-1", "3x4"}));
    EXPECT_EQ(error_of<std::runtime_error>([&] { read_made(made, {.number = 5}); }),
              "kolam 5 does not exist: the picture has 4 kolams that can be read");
}

/// Chance finds lattices in textures, such as the grain of wood, whose lines run beside each other.
TEST(PhotographMarks, LinesThatNeverCrossAreNotAKolam) {
    MadePhotograph made = made_of("4x5", 2, 0.4);
    for (std::size_t gap = 0; gap < made.states.size(); ++gap) {
        made.states[gap] = made.grid.gaps()[gap].side == 0 ? GapState::joined : GapState::turned;
    }
    const std::string refusal = error_of<NoKolam>([&] { read_made(made); }, "read");
    EXPECT_TRUE(has(refusal, "20 dots on a lattice, but lines cross between none of them")) << refusal;
}

/// A picture of black lines that a function draws on white.
class Sketch {
public:
    Sketch(int width, int height)
        : width_(width), height_(height), pixels_(3 * static_cast<std::size_t>(width * height), 240) {}
    void disc(glm::dvec2 at, double radius) {
        for (int y = std::max(0, static_cast<int>(at.y - radius));
             y <= std::min(height_ - 1, static_cast<int>(at.y + radius) + 1); ++y) {
            for (int x = std::max(0, static_cast<int>(at.x - radius));
                 x <= std::min(width_ - 1, static_cast<int>(at.x + radius) + 1); ++x) {
                if (glm::distance(at, glm::dvec2(x, y)) > radius) continue;
                for (std::size_t c = 0; c < 3; ++c) pixels_[3 * static_cast<std::size_t>(y * width_ + x) + c] = 30;
            }
        }
    }
    void line(glm::dvec2 from, glm::dvec2 to, double width) {
        const int steps = static_cast<int>(glm::distance(from, to)) + 1;
        for (int i = 0; i <= steps; ++i) disc(from + (to - from) * (static_cast<double>(i) / steps), width / 2);
    }
    void ring(glm::dvec2 at, double radius, double width) {
        for (int i = 0; i < 200; ++i) {
            const double angle = 2 * std::numbers::pi * i / 200;
            disc(at + radius * glm::dvec2(std::cos(angle), std::sin(angle)), width / 2);
        }
    }
    void write(const std::filesystem::path& path) const {
        ImageSpec spec;
        spec.format = "png";
        spec.width = width_;
        spec.height = height_;
        const auto writer = open_image(path, spec);
        writer->rows(0, height_, pixels_);
        writer->close();
    }

private:
    int width_, height_;
    std::vector<std::uint8_t> pixels_;
};

/// The message about a refused picture, after its overlay has been written.
std::string refusal_of(const Sketch& sketch) {
    const ScratchFolder folder;
    sketch.write(folder.path() / "picture.png");
    try {
        const Photograph read = read_photograph(folder.path() / "picture.png");
        return "read as " + read.kolam.grid.text();
    } catch (const NoKolam& refused) {
        write_overlay(refused.picture(), folder.path() / "overlay.png");
        const DecodedPicture overlay = read_picture(folder.path() / "overlay.png", 4000, 10'000'000);
        EXPECT_EQ(overlay.width, refused.picture().picture.width);
        return refused.what();
    }
}

TEST(PhotographMarks, RefusalsReportFindings) {
    // Nothing but a bar.
    Sketch bar(800, 600);
    bar.line({100, 300}, {700, 310}, 20);
    EXPECT_EQ(refusal_of(bar), "no kolam found: no round spots that could be dots");
    // Spots anywhere.
    Sketch spots(800, 600);
    PictureChance chance(7);
    for (int i = 0; i < 31; ++i) spots.disc({chance.uniform(50, 750), chance.uniform(50, 550)}, 6);
    EXPECT_TRUE(has(refusal_of(spots), "round spots"));
    EXPECT_FALSE(has(refusal_of(spots), "read as"));
    // Rings around single dots.
    Sketch rings(800, 800);
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 6; ++x) {
            rings.disc({100 + 120 * x, 100 + 120 * y}, 8);
            rings.ring({100 + 120 * x, 100 + 120 * y}, 45, 8);
        }
    }
    EXPECT_EQ(refusal_of(rings),
              "no kolam found: 36 round spots, 36 dots on a lattice, but lines lead to only 0 of them from another");
    // Nodes and edges of a graph: lines lead from dot to dot, not around them.
    Sketch graph(800, 800);
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 6; ++x) {
            const glm::dvec2 at(100 + 120 * x, 100 + 120 * y);
            graph.disc(at, 14);
            if (x < 5 && (x + y) % 3 != 0) graph.line(at, at + glm::dvec2(120, 0), 5);
            if (y < 5 && (x + 2 * y) % 3 != 1) graph.line(at, at + glm::dvec2(0, 120), 5);
        }
    }
    EXPECT_TRUE(has(refusal_of(graph), "no kolam found"));
    // Dots that straight lines join, and dots within a frame, drawn large: the picture is made smaller by averaging.
    Sketch bricks(1600, 1600);
    Sketch framed(1600, 1600);
    const std::vector<glm::dvec2> corners = {{100, 100}, {1500, 100}, {1500, 1500}, {100, 1500}};
    for (std::size_t i = 0; i < 4; ++i) framed.line(corners[i], corners[(i + 1) % 4], 12);
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 5; ++x) {
            const glm::dvec2 at(200 + 300 * x, 200 + 300 * y);
            bricks.disc(at, 24);
            if (x < 4) bricks.line(at, at + glm::dvec2(300, 0), 8);
            if (y < 4 && (x + y) % 2 == 1) bricks.line(at, at + glm::dvec2(0, 300), 8);
            framed.disc({400 + 200 * x, 400 + 200 * y}, 16);
        }
    }
    EXPECT_EQ(refusal_of(bricks),
              "no kolam found: 25 round spots, 25 dots on a lattice, but no line runs around most "
              "of them from one to another");
    EXPECT_EQ(refusal_of(framed),
              "no kolam found: 25 round spots, 25 dots on a lattice, but no line runs around them "
              "from one to another");
    // A ring of dots.
    Sketch circle(800, 800);
    for (int i = 0; i < 24; ++i) {
        const double angle = 2 * std::numbers::pi * i / 24;
        circle.disc(glm::dvec2(400) + 300.0 * glm::dvec2(std::cos(angle), std::sin(angle)), 8);
    }
    EXPECT_FALSE(has(refusal_of(circle), "vary by 0 %"));
    // A woven lattice with rows of dots along it.
    Sketch woven(900, 900);
    for (int i = 0; i <= 10; ++i) {
        woven.line({150, 150.0 + 60 * i}, {750, 150.0 + 60 * i}, 12);
        woven.line({150.0 + 60 * i, 150}, {150.0 + 60 * i, 750}, 12);
    }
    for (int i = 0; i < 24; ++i) {
        woven.disc({110, 150.0 + 25 * i}, 6);
        woven.disc({790, 150.0 + 25 * i}, 6);
        woven.disc({150.0 + 25 * i, 110}, 6);
        woven.disc({150.0 + 25 * i, 790}, 6);
    }
    EXPECT_TRUE(has(refusal_of(woven), "no kolam found"));
}

}  // namespace sikku::photograph_marks_test
