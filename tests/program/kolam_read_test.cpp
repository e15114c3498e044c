// tests/program/kolam_read_test.cpp: runs the program to read kolams, and to write them in other formats.
#include "tests/files.h"
#include "tests/photograph_maker.h"
#include "tests/program.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace sikku::kolam_read_test {

class KolamRead : public ::testing::Test {
protected:
    Outcome kolam(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "kolam");
        Surroundings here{.folder = folder_.path()};
        return run(arguments, here);
    }
    /// The comment of a pattern that lists its gaps.
    std::string gaps(const std::string& file) {
        const std::string text = contents(folder_ / file);
        const std::size_t at = text.find("// grid: ");
        return at == std::string::npos ? "" : text.substr(at, text.find("\n\n", at) - at);
    }
    void write_photo(const std::string& name, const std::string& grid, const std::string& states) {
        DotGrid dots = parse_dot_grid(grid);
        GapStates gap_states = parse_gap_states(dots, states);
        MadePhotograph made{std::move(dots), std::move(gap_states)};
        made.width = 800;
        made.height = 600;
        write_photograph(made, folder_ / name);
    }
    ScratchFolder folder_;
};

TEST_F(KolamRead, FormatsComeBack) {
    for (const char* grid : {"5x5", "1-3-5-3-1", "oo.oo/ooooo/.ooo./ooooo/oo.oo"}) {
        ASSERT_EQ(kolam({"--grid", grid, "--single-line", "-o", "a.lsys"}).status, 0);
        for (const std::string other : {"b.kolam.json", "b.csv", "b.yaml"}) {
            SCOPED_TRACE(grid + (" as " + other));
            const Outcome written = kolam({"a.lsys", "-o", other});
            ASSERT_EQ(written.status, 0) << written.errors;
            const Outcome read = kolam({"--read", other, "-o", "c.lsys"});
            ASSERT_EQ(read.status, 0) << read.errors;
            EXPECT_TRUE(has(read.errors, ", 1 line"));
            EXPECT_EQ(gaps("c.lsys"), gaps("a.lsys"));
            ASSERT_EQ(kolam({"c.lsys", "-o", "again" + other}).status, 0);
            EXPECT_EQ(contents(folder_ / ("again" + other)), contents(folder_ / other));
            ASSERT_EQ(kolam({"--grid", grid, "--single-line", "-o", "made" + other}).status, 0);
            EXPECT_EQ(contents(folder_ / ("made" + other)), contents(folder_ / other));
        }
    }
}

/// Rounded lines leave joined gaps far behind; then the reading is refused, or names the gaps.
TEST_F(KolamRead, RoundedDrawingsWithJoinedGapsAreDoubted) {
    for (const char* seed : {"0", "3", "5", "6", "7", "9"}) {
        ASSERT_EQ(kolam({"--grid", "5-3 idukku", "--joined", "0.3", "--seed", seed, "-o", "a.lsys"}).status, 0);
        ASSERT_TRUE(has(contents(folder_ / "a.lsys"), " joined")) << seed;
        Surroundings here{.folder = folder_.path()};
        ASSERT_EQ(run({"draw", "a.lsys", "--dots", "-o", "a.svg"}, here).status, 0);
        const Outcome read = kolam({"--read", "a.svg", "-o", "b.lsys"});
        EXPECT_TRUE(read.status == 1 || has(read.errors, "gaps are doubtful")) << seed << read.errors;
    }
}

TEST_F(KolamRead, DrawingsComeBack) {
    for (const char* grid : {"5x5", "5-3 idukku"}) {
        const char* joined = std::string_view(grid) == "5x5" ? "0.3" : "0";
        ASSERT_EQ(kolam({"--grid", grid, "--joined", joined, "-o", "a.lsys"}).status, 0);
        Surroundings here{.folder = folder_.path()};
        ASSERT_EQ(run({"draw", "a.lsys", "--dots", "-o", "a.svg"}, here).status, 0);
        const Outcome read = kolam({"--read", "a.svg", "-o", "b.lsys"});
        ASSERT_EQ(read.status, 0) << read.errors;
        EXPECT_FALSE(has(read.errors, "doubtful"));
        EXPECT_EQ(gaps("b.lsys"), gaps("a.lsys")) << grid;
        // The pattern without its comments.
        std::string text = contents(folder_ / "a.lsys");
        for (std::size_t at = text.find("// g"); at != std::string::npos; at = text.find("// g")) {
            text.erase(at, text.find('\n', at) + 1 - at);
        }
        folder_.write("plain.lsys", text);
        ASSERT_EQ(kolam({"plain.lsys", "-o", "c.lsys"}).status, 0);
        EXPECT_EQ(gaps("c.lsys"), gaps("a.lsys")) << grid;
    }
}

TEST_F(KolamRead, PhotographsGiveAPatternAnOverlayAndAReport) {
    write_photo("photo.jpg", "4x4", "101 1111 010 1001 111 1111 101");
    const Outcome read =
        kolam({"--read", "photo.jpg", "-o", "a.lsys", "--overlay", "found.png", "--json", "--fix", "1,2: join"});
    ASSERT_EQ(read.status, 0) << read.errors;
    EXPECT_TRUE(has(read.output, "\"grid\": \"4x4\", \"dots\": 16, \"gaps\": 24"));
    EXPECT_TRUE(has(read.output, "\"repaired\": [{\"row\": 1, \"gap\": 2, \"state\": \"joined\""));
    EXPECT_TRUE(has(gaps("a.lsys"), "// gaps: 121 1111 010 1001 111 1111 101"));
    EXPECT_GT(std::filesystem::file_size(folder_ / "found.png"), 10'000U);
    // The same picture makes the same files.
    const std::string overlay = contents(folder_ / "found.png");
    ASSERT_EQ(kolam({"--read", "photo.jpg", "-o", "b.lsys", "--overlay", "found.png", "--fix", "1,2: join"}).status,
              0);
    EXPECT_EQ(contents(folder_ / "b.lsys"), contents(folder_ / "a.lsys"));
    EXPECT_EQ(contents(folder_ / "found.png"), overlay);
    // And the pattern is a kolam.
    EXPECT_TRUE(has(kolam({"a.lsys"}).output, "kolam      yes"));
}

TEST_F(KolamRead, PhotographsMayHaveAnExpectedGrid) {
    write_photo("photo.jpg", "4x4", "101 1111 010 1001 111 1111 101");
    const Outcome read = kolam({"--read", "photo.jpg", "--grid", "4x4", "-o", "a.lsys", "--json"});
    ASSERT_EQ(read.status, 0) << read.errors;
    EXPECT_TRUE(has(read.output, "\"completed\": []"));
    folder_.write("grid.txt", "oooo\noooo\noooo\noooo\n");
    EXPECT_EQ(kolam({"--read", "photo.jpg", "--grid", "@grid.txt", "-o", "b.lsys"}).status, 0);
    EXPECT_EQ(contents(folder_ / "b.lsys"), contents(folder_ / "a.lsys"));
    const Outcome other = kolam({"--read", "photo.jpg", "--grid", "6x6", "-o", "c.lsys", "--overlay", "found.png"});
    EXPECT_EQ(other.status, 1);
    EXPECT_EQ(other.errors, "sikku: photo.jpg: found 16 dots (4x4); expected 36 dots (6x6)\n");
    EXPECT_GT(std::filesystem::file_size(folder_ / "found.png"), 10'000U);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "c.lsys"));
}

TEST_F(KolamRead, PhotographsMayBeCutAndChangedByHand) {
    write_photo("photo.jpg", "4x4", "101 1111 010 1001 111 1111 101");
    ASSERT_EQ(kolam({"--read", "photo.jpg", "-o", "a.lsys"}).status, 0);
    for (const std::vector<std::string>& part : {std::vector<std::string>{"--crop", "0,0,800,600"},
                                                 {"--corners", "0,0", "800,0", "800,600", "0,600"},
                                                 {"--corners", "0,0 0,600 800,600 800,0"},
                                                 {"--part", "1"}}) {
        std::vector<std::string> arguments = {"--read", "photo.jpg", "-o", "b.lsys"};
        arguments.insert(arguments.end(), part.begin(), part.end());
        const Outcome read = kolam(arguments);
        EXPECT_EQ(read.status, 0) << read.errors;
        EXPECT_EQ(gaps("b.lsys"), gaps("a.lsys"));
    }
    const Outcome fixed =
        kolam({"--read", "photo.jpg", "-o", "b.lsys", "--fix", "no dot 1,1; no dot 4,4; 1,1: join"});
    ASSERT_EQ(fixed.status, 0) << fixed.errors;
    EXPECT_TRUE(has(fixed.errors, "by hand, 0 dots added and 2 removed"));
    EXPECT_TRUE(has(gaps("b.lsys"), "// gaps: 21 111 010 1001 111 111 10"));
    // Dots of other files, whose new gaps turn back.
    const Outcome dots = kolam({"--read", "b.lsys", "-o", "c.lsys", "--fix", "dot 1,1", "--fix", "dot 4,4"});
    ASSERT_EQ(dots.status, 0) << dots.errors;
    EXPECT_TRUE(has(gaps("c.lsys"), "// gaps: 021 0111 010 1001 111 1110 100"));
    EXPECT_TRUE(has(dots.errors, "4 of 24 gaps are doubtful"));
}

/// The process that decodes a picture gets descriptors 0 to 2, which may be those of the file and of its answers.
TEST_F(KolamRead, PhotographsNeedNoStandardStreams) {
    write_photo("a.png", "3x3", "all");
    for (const char* closed : {"<&-", "<&- >&-", "2>&-", "<&- >&- 2>&-"}) {
        std::filesystem::remove(folder_ / "k.lsys");
        const std::string command = std::string("'") + SIKKU_PROGRAM + "' -q kolam --read a.png -o k.lsys " + closed;
        const Outcome outcome = run({"-c", command}, {.folder = folder_.path(), .program = "/bin/sh"});
        EXPECT_EQ(outcome.status, 0) << closed << outcome.errors;
        EXPECT_EQ(gaps("k.lsys").substr(0, 13), "// grid: 3x3\n") << closed;
    }
}

/// An untrusted title or file name once set keys of the pattern, or made it invalid.
TEST_F(KolamRead, TitlesAndNamesStayInTheirLine) {
    const std::string design =
        R"("design": {"rows": 2, "cols": 2, "mask": ["11", "11"], "h": ["x", "x"], "v": ["xx"]}})";
    const std::string head = R"({"format": "kolam", "version": 1, "title": ")";
    const std::string svg =
        "<svg><title>A&#10;stroke: none&#10;//</title><g fill=\"none\" stroke=\"red\"><path d=\"M0 1C.5 1.5.5 2.5 0 "
        "2.5S-.5 1.5 0 1S.5-.5 0-.5S-.5.5 0 1z\"/></g><circle cy=\"0\" r=\".1\"/><circle cy=\"2\" r=\".1\"/></svg>";
    const std::vector<std::pair<std::string, std::string>> files = {
        {"lines.json", head + "Lotus\\nstroke: none\\n//\", " + design},
        {"comment.json", head + "/* open\", " + design},
        {"separator.json", head + "a\u2028stroke: none\", " + design},
        {"slash.json", head + "ends in \\\\\", " + design},
        {"a\nstroke: none\n.json", head + "plain\", " + design},
        {"/* open.json", head + "plain\", " + design},
        {"title.svg", svg}};
    for (const auto& [given, text] : files) {
        SCOPED_TRACE(given);
        std::string name = given;
        std::replace(name.begin(), name.end(), '/', ' ');
        folder_.write(name, text);
        const Outcome outcome = kolam({"--read", name, "-o", "k.lsys"});
        ASSERT_EQ(outcome.status, 0) << outcome.errors;
        const std::string pattern = contents(folder_ / "k.lsys");
        EXPECT_FALSE(has(pattern, "\nstroke: none"));
        EXPECT_FALSE(has(pattern, "/*"));
        EXPECT_FALSE(has(outcome.errors, "\nstroke"));
        const Outcome checked = run({"check", "k.lsys"}, {.folder = folder_.path()});
        EXPECT_EQ(checked.status, 0) << checked.output;
        EXPECT_EQ(checked.output, "");
    }
}

TEST_F(KolamRead, MistakesAreNamed) {
    folder_.write("text.txt", "a text\n");
    folder_.write("broken.json", "{\"format\": \"kolam\"");
    folder_.write("broken.csv", "x-kolam 1,y-kolam 1\n1,2\n1,a\n");
    folder_.write("fake.jpg", "\xFF\xD8\xFF is no JPEG");
    folder_.write("ring.json",
                  R"({"format":"kolam","version":1,"design":{"rows":1,"cols":2,"mask":["11"],"h":["j"],"v":[]}})");
    const auto expect = [&](std::vector<std::string> arguments, int status, const std::string& message) {
        const Outcome outcome = kolam(std::move(arguments));
        EXPECT_EQ(outcome.status, status) << message << "\n" << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, message));
        EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "a.lsys"));
    };
    expect({"--read", "none.jpg", "-o", "a.lsys"}, 2, "no such file");
    expect({"--read", "text.txt", "-o", "a.lsys"}, 1, "text.txt: unknown format");
    // Damaged beyond its first bytes, and within them.
    folder_.write("cut.webp", std::string("RIFF\x40\0\0\0WEBPVP8 \x90\0\0\0....", 24));
    folder_.write("bent.webp", std::string("RIFF\x40\0\0\0WEBXVP8 ", 16));
    expect({"--read", "cut.webp", "-o", "a.lsys", "--overlay", "b.png"}, 1, "cut.webp: the picture is damaged");
    expect({"--read", "bent.webp", "-o", "a.lsys", "--overlay", "b.png"}, 1,
           "bent.webp: not a picture, or a damaged");
    expect({"--read", "broken.json", "-o", "a.lsys"}, 1, "broken.json: not a valid .kolam.json file");
    expect({"--read", "broken.csv", "-o", "a.lsys"}, 1, "broken.csv: row 3: expected two numbers");
    expect({"--read", "fake.jpg", "-o", "a.lsys"}, 1, "fake.jpg: the picture is damaged");
    expect({"--read", "ring.json", "-o", "a.svg"}, 2, "expected a pattern file, NAME.lsys");
    expect({"--read", "ring.json", "-o", "a.yaml"}, 1, "joined gaps, as in row 1, gap 1");
    expect({"--read", "ring.json", "--overlay", "a.png"}, 2, "--overlay applies only to photographs");
    expect({"--read", "ring.json", "--overlay", "a.jpg"}, 2, "expected a PNG");
    expect({"--read", "ring.json", "--fix", "2,1: cross"}, 2, "numbered 1 to 1");
    expect({"--read", "ring.json", "--json"}, 2, "--json needs -o FILE");
    expect({"--read", "ring.json", "--grid", "3x3"}, 2, "--grid with --read applies only to photographs");
    expect({"--read", "ring.json", "--crop", "1,2,3,4"}, 2, "--crop with --read applies only to photographs");
    expect({"--read", "ring.json", "--symmetry", "D4", "--grid", "3x3"}, 2, "--read excludes --symmetry");
    expect({"--read", "ring.json", "--radial", "8x5"}, 2, "--read excludes --radial");
    expect({"--read", "ring.json", "--fix", "dot 1,1"}, 2, "--fix 'dot 1,1': there is a dot already");
    expect({"--read", "fake.jpg", "-o", "a.lsys", "--grid", "x"}, 2, "--grid 'x': expected ROWSxCOLUMNS");
    expect({"--read", "fake.jpg", "-o", "a.lsys", "--grid", "3x3", "--lattice", "interlaced"}, 2,
           "--lattice expects");
    expect({"--read", "fake.jpg", "-o", "a.lsys", "--crop", "1,2,3"}, 2, "--crop '1,2,3': expected X,Y,WIDTH,HEIGHT");
    expect({"--read", "fake.jpg", "-o", "a.lsys", "--corners", "1,2"}, 2, "--corners '1,2': expected four points");
    expect({"--fix", "1,1: cross", "snake-kolam"}, 2, "--read");
    expect({"-o", "a.lsys"}, 2, "-o needs PATTERN");
}

}  // namespace sikku::kolam_read_test
