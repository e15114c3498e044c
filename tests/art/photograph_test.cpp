// tests/art/photograph_test.cpp: kolams read from pictures that look like photographs, of which the truth is known.
#include "art/reading/photograph.h"

#include "art/kolam/dot_grid_pattern.h"
#include "art/kolam/dot_grid_symmetry.h"
#include "art/prints.h"
#include "art/reading/kolam_lines.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/photograph_maker.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace sikku::photograph_test {

/// A picture of one of eight grids, in all ways that the seed chooses.
MadePhotograph made_photograph(std::uint32_t number, double level) {
    static const std::vector<std::string> grids = {"7x7",         "1-3-5-7-5-3-1", "7-4 idukku",
                                                   "9-5 idukku",  "5x9",           "oo.oo/ooooo/.ooo./ooooo/oo.oo",
                                                   "15-8 idukku", "11x11"};
    DotGrid grid = parse_dot_grid(grids[number % grids.size()]);
    const bool is_square = grid.lattice() == DotLattice::square;
    RandomKolam random{.seed = 100 + number, .joined = number % 3 == 1 ? 0.3 : 0.0};
    if (number % 2 == 0) random.symmetry = usual_symmetries(grid, false).front();
    GapStates states = random_states(grid, random);
    MadePhotograph made{std::move(grid), std::move(states)};
    made.light_lines = number % 2 == 1;
    made.line_width = is_square ? 0.07 + 0.02 * (number % 4) : 0.055 + 0.012 * (number % 4);
    made.dot_radius = 0.05 + 0.015 * (number % 4);
    made.turn = is_square ? static_cast<double>(number * 37 % 31) - 15 : static_cast<double>(number * 37 % 21) - 10;
    made.seed = 1000 + number;
    made.distortion = {level, level, level, level, level, level, level};
    return made;
}

struct Score {
    std::size_t pictures = 0;
    std::size_t grids = 0;  ///< read as they are
    std::size_t gaps = 0;
    std::size_t right = 0;
    std::size_t doubtful = 0;
    std::size_t silent = 0;  ///< wrong without a doubt
};

Score read_pictures(std::uint32_t first, std::uint32_t count, std::uint32_t step, double level) {
    Score score;
    const ScratchFolder folder;
    for (std::uint32_t number = first; number < first + count * step; number += step) {
        const MadePhotograph made = made_photograph(number, level);
        const auto path = folder.path() / "photo.jpg";
        write_photograph(made, path);
        ++score.pictures;
        SCOPED_TRACE(fmt::format("picture {} of {}", number, made.grid.text()));
        try {
            const Photograph photograph = read_photograph(path);
            const ReadKolam& kolam = photograph.kolam;
            if (kolam.grid.text() != made.grid.text()) {
                // A grid that is read otherwise has to be noticed by its gaps.
                if (level <= 1) ADD_FAILURE() << "read as " << kolam.grid.text();
                continue;
            }
            ++score.grids;
            score.gaps += made.states.size();
            score.doubtful += kolam.doubtful().size();
            for (std::uint32_t gap = 0; gap < made.states.size(); ++gap) {
                const bool is_right = kolam.states[gap] == made.states[gap];
                score.right += is_right;
                if (!is_right && !kolam.is_doubtful(gap)) {
                    ++score.silent;
                    if (level <= 1)
                        ADD_FAILURE() << "gap " << gap << " is wrong, with the certainty " << kolam.certainty[gap];
                }
            }
        } catch (const std::runtime_error& error) {
            if (level <= 1) ADD_FAILURE() << error.what();
        }
    }
    return score;
}

void expect_good(const Score& score) {
    EXPECT_EQ(score.grids, score.pictures);
    EXPECT_GE(static_cast<double>(score.right), 0.98 * static_cast<double>(score.gaps));
    EXPECT_EQ(score.silent, 0U);
    // A reader that doubts everything is of no use.
    EXPECT_LE(static_cast<double>(score.doubtful), 0.25 * static_cast<double>(score.gaps));
    fmt::print("{} pictures, {} gaps: {:.2f} % right, {:.2f} % doubtful\n", score.pictures, score.gaps,
               100.0 * static_cast<double>(score.right) / static_cast<double>(score.gaps),
               100.0 * static_cast<double>(score.doubtful) / static_cast<double>(score.gaps));
}

TEST(Photograph, ReadsKolamsAtModerateDistortion) {
    expect_good(read_pictures(0, 6, 1, 1));
}

TEST(Photograph, ReadsManyKolamsInTheFullCheck) {
    if (!std::getenv("SIKKU_FULL")) GTEST_SKIP() << "a minute; SIKKU_FULL=1 runs it";
    expect_good(read_pictures(0, 64, 1, 1));
}

/// Strong distortion may hide a kolam, or a part of it; wrong gaps without a doubt stay below one in 200.
TEST(Photograph, DoubtsWhatIsWrongAtStrongDistortion) {
    const bool full = std::getenv("SIKKU_FULL") != nullptr;
    const Score score = read_pictures(full ? 0 : 8, full ? 24 : 2, 1, 1.5);
    EXPECT_LE(200 * score.silent, score.gaps);
    EXPECT_GE(3 * score.grids, 2 * score.pictures);
}

/// The corner that is red when the picture is upright, stored as each of the eight EXIF orientations says.
TEST(Photograph, IsUprightWhateverTheCamera) {
    const ScratchFolder folder;
    const std::string path = folder.file("turned.tif");
    constexpr int width = 6;
    constexpr int height = 4;
    // Where the first stored pixel of a picture is seen: top left, top right, bottom right, bottom left, then with
    // rows and columns exchanged. Source: Exif 2.32, tag 274.
    const std::vector<std::pair<bool, bool>> seen_right_and_below = {{false, false}, {true, false},  {true, true},
                                                                     {false, true},  {false, false}, {true, false},
                                                                     {true, true},   {false, true}};
    for (int orientation = 1; orientation <= 8; ++orientation) {
        std::vector<std::uint8_t> pixels(std::size_t{3} * width * height, 200);
        pixels[1] = pixels[2] = 0;
        OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
        spec.attribute("Orientation", orientation);
        const auto output = OIIO::ImageOutput::create("tiff");
        ASSERT_TRUE(output && output->open(path, spec) && output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) &&
                    output->close());
        const DecodedPicture read = read_picture(path, 1500, 1'000'000);
        EXPECT_EQ(read.width, orientation < 5 ? width : height) << orientation;
        EXPECT_EQ(read.height, orientation < 5 ? height : width) << orientation;
        const auto [is_right, is_below] = seen_right_and_below[static_cast<std::size_t>(orientation - 1)];
        const int x = is_right ? read.width - 1 : 0;
        const int y = is_below ? read.height - 1 : 0;
        for (int i = 0; i < read.width * read.height; ++i) {
            const bool is_red = read.pixels[3 * static_cast<std::size_t>(i) + 1] < 100;
            EXPECT_EQ(is_red, i == y * read.width + x) << orientation << ", pixel " << i;
        }
    }
}

TEST(Photograph, IsMadeSmallerByAveraging) {
    const ScratchFolder folder;
    ImageSpec spec;
    spec.format = "png";
    spec.width = 7;
    spec.height = 5;
    std::vector<std::uint8_t> pixels(std::size_t{3} * 7 * 5);
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = i / 3 % 2 == 0 ? 100 : 200;
    const auto writer = open_image(folder.path() / "grey.png", spec);
    writer->rows(0, 5, pixels);
    writer->close();
    const DecodedPicture read = read_picture(folder.path() / "grey.png", 4, 1000);
    EXPECT_EQ(read.width, 3);
    EXPECT_EQ(read.height, 2);
    EXPECT_EQ(read.file_width, 7);
    EXPECT_EQ(read.pixels, std::vector<std::uint8_t>(18, 150));
}

TEST(Photograph, OverlayShowsDotsAndDoubts) {
    const ScratchFolder folder;
    MadePhotograph made = made_photograph(0, 0.5);
    const auto path = folder.path() / "photo.jpg";
    write_photograph(made, path);
    Photograph photograph = read_photograph(path);
    photograph.kolam.certainty[3] = 0;
    write_overlay(photograph, folder.path() / "overlay.png");
    const DecodedPicture overlay = read_picture(folder.path() / "overlay.png", 4000, 10'000'000);
    ASSERT_EQ(overlay.width, photograph.picture.width);
    const auto colour_near = [&](glm::dvec2 at, int reach, auto&& is_wanted) {
        for (int y = static_cast<int>(at.y) - reach; y <= static_cast<int>(at.y) + reach; ++y) {
            for (int x = static_cast<int>(at.x) - reach; x <= static_cast<int>(at.x) + reach; ++x) {
                const auto i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(overlay.width) +
                                    static_cast<std::size_t>(x));
                if (is_wanted(overlay.pixels[i], overlay.pixels[i + 1], overlay.pixels[i + 2])) return true;
            }
        }
        return false;
    };
    const auto is_orange = [](int r, int g, int b) { return r > 240 && g > 100 && g < 140 && b < 20; };
    const GridGap& gap = made.grid.gaps()[3];
    const glm::dvec2 middle = 0.5 * (lattice_point(DotLattice::square, made.grid.dots()[gap.from]) +
                                     lattice_point(DotLattice::square, made.grid.dots()[gap.to]));
    EXPECT_TRUE(colour_near(photograph.map(middle), 40, is_orange));
    const glm::dvec2 dot = lattice_point(DotLattice::square, made.grid.dots()[0]);
    EXPECT_TRUE(colour_near(photograph.map(dot), 20, [](int r, int g, int b) { return r + g + b > 740; }));
}

std::string error_of(const std::filesystem::path& path, std::uint64_t most = 100'000'000) {
    return sikku::error_of<std::runtime_error>([&] { read_photograph(path, {.most_pixels = most}); }, "no error");
}

TEST(Photograph, RefusesWhatIsNone) {
    const ScratchFolder folder;
    const auto path = folder.path() / "photo.jpg";
    const auto write = [&](const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; };
    EXPECT_TRUE(has(error_of(folder.path() / "none.jpg"), "not a regular file"));
    EXPECT_TRUE(has(error_of(folder.path()), "not a regular file"));
    write("axiom: F\n");
    EXPECT_TRUE(has(error_of(path), "not a picture"));
    write("\xFF\xD8\xFFnothing");
    EXPECT_TRUE(has(error_of(path), "damaged"));

    MadePhotograph made = made_photograph(0, 1);
    write_photograph(made, path);
    EXPECT_TRUE(has(error_of(path, 1000), "at most"));
    std::string bytes(std::filesystem::file_size(path), '\0');
    std::ifstream(path, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    // The first tenth of a photograph: an error, or at least no kolam that is certain.
    write(bytes.substr(0, bytes.size() / 10));
    EXPECT_NE(error_of(path), "no error");

    // Noise, and nothing at all.
    for (const double noise : {0.0, 60.0}) {
        PictureChance chance(3);
        ImageSpec spec;
        spec.format = "png";
        spec.width = spec.height = 300;
        std::vector<std::uint8_t> pixels(3 * 300 * 300);
        for (auto& value : pixels) value = static_cast<std::uint8_t>(128 + noise * chance.uniform(-1, 1));
        const auto writer = open_image(folder.path() / "noise.png", spec);
        writer->rows(0, 300, pixels);
        writer->close();
        const std::string error = error_of(folder.path() / "noise.png");
        EXPECT_NE(error, "no error") << noise;
    }
}

/// Writes a kolam as `draw` does, with options, and reads it.
Photograph read_drawn(const std::string& grid, const OptionValues& values) {
    const ScratchFolder folder;
    const DotGrid dots = parse_dot_grid(grid);
    const std::string pattern = kolam_pattern(dots, random_states(dots, {.seed = 2}), {}).text;
    OptionValues all = {{"dots", ""}, {"size", "150x150mm"}, {"dpi", "150"}};
    all.insert(all.end(), values.begin(), values.end());
    folder.write("kolam.png", draw(parse("kolam.lsys", pattern), "png", all));
    return read_photograph(folder.path() / "kolam.png");
}

bool has_note(const Photograph& photograph, const std::string& part) {
    const auto& notes = photograph.kolam.notes;
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(Photograph, LeavesBordersOut) {
    for (const char* border : {"kaavi", "padi", "lotus", "rope", "diamonds", "waves"}) {
        SCOPED_TRACE(border);
        const Photograph photograph = read_drawn("5x5", {{"border", border}});
        EXPECT_EQ(photograph.kolam.grid.text(), "5x5");
        EXPECT_TRUE(photograph.kolam.doubtful().empty());
    }
    EXPECT_TRUE(has_note(read_drawn("5x5", {{"border", "rope"}}), "a border around the kolam was left out"));
}

TEST(Photograph, ReportsTheEdgeOnlyIfTheKolamSeemsToContinue) {
    const char* const continues = "seems to continue outside";
    for (const char* grid : {"5x5", "7-4 idukku"}) {
        for (const char* margin : {"20mm", "10mm", "2mm"}) {
            EXPECT_FALSE(has_note(read_drawn(grid, {{"margin", margin}}), continues)) << grid << ", " << margin;
        }
    }
    // A part of a kolam.
    EXPECT_TRUE(has_note(read_drawn("9x9", {{"window", "2,-5,11,4"}}), continues));
}

/// Dots without lines, and a page of letters.
TEST(Photograph, RefusesPicturesOfSomethingElse) {
    EXPECT_THROW(read_drawn("6x6", {{"stroke", "0.01 step #7d3324"}}), std::runtime_error);
}

/// A damaged header can claim a size at which blurs and degenerate lattices took minutes.
TEST(Photograph, TakesSecondsForAnySizeAHeaderClaims) {
    const ScratchFolder folder;
    const auto path = folder.path() / "noise.jpg";
    ImageSpec spec;
    spec.format = "jpg";
    spec.width = spec.height = 300;
    std::vector<std::uint8_t> pixels(3 * 300 * 300);
    PictureChance chance(3);
    for (auto& value : pixels) value = static_cast<std::uint8_t>(chance.uniform(0, 255));
    const auto writer = open_image(path, spec);
    writer->rows(0, 300, pixels);
    writer->close();
    std::string bytes = contents(path);
    const std::size_t frame = bytes.find("\xFF\xC0");
    ASSERT_NE(frame, std::string::npos);
    bytes.replace(frame + 5, 4, std::string("\x26\xAC\x26\xAC"));  // 9900 x 9900
    folder.write("claims.jpg", bytes);
    const std::clock_t begin = std::clock();
    EXPECT_NE(error_of(folder.path() / "claims.jpg"), "no error");
    // Sanitizers take four times as long.
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, sanitized ? 100 : 25);
}

/// libpng would print its own words on the error output.
TEST(Photograph, DamagedPngsAreRefusedWithoutTheWordsOfLibraries) {
    const ScratchFolder folder;
    const DotGrid dots = parse_dot_grid("3x3");
    const std::string pattern = kolam_pattern(dots, parse_gap_states(dots, "all"), {}).text;
    const std::string png =
        draw(parse("kolam.lsys", pattern), "png", {{"dots", ""}, {"size", "60x60mm"}, {"dpi", "100"}});
    const auto refuses = [&](const std::string& bytes) {
        folder.write("damaged.png", bytes);
        testing::internal::CaptureStderr();
        const std::string error = error_of(folder.path() / "damaged.png");
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
        EXPECT_TRUE(has(error, "damaged"));
    };
    folder.write("sound.png", png);
    EXPECT_EQ(error_of(folder.path() / "sound.png"), "no error");
    for (const std::size_t at : {16U, 24U, 25U, 29U}) {  // in the header
        std::string bytes = png;
        bytes[at] = static_cast<char>(bytes[at] ^ 5);
        refuses(bytes);
    }
    const std::size_t pixels = png.find("IDAT");
    ASSERT_NE(pixels, std::string::npos);
    for (std::size_t i = 4; i < 300; i += 37) {
        std::string bytes = png;
        bytes[pixels + i] = static_cast<char>(bytes[pixels + i] ^ 0x55);
        refuses(bytes);
    }
    refuses(png.substr(0, png.size() - 12));
    refuses(png.substr(0, pixels + 60));
}

/// Pictures that claim sizes of gigabytes, from the corpus of files that the program reads elsewhere.
TEST(Photograph, ChecksSizesBeforePixels) {
    const std::filesystem::path corpus = std::filesystem::path(SIKKU_SOURCE_DIR) / "tests/corpus/show";
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
        const std::string extension = entry.path().extension();
        if (extension != ".png" && extension != ".jpg" && extension != ".tif") continue;
        EXPECT_NE(error_of(entry.path(), 20'000'000), "no error") << entry.path();
    }
}

}  // namespace sikku::photograph_test
