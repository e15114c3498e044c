// tests/program/growth_test.cpp: runs the program to make animations, views and models.
#include "art/motion/growth.h"
#include "tests/program.h"
#include "tests/tools.h"

#include <pugixml.hpp>

#include <set>
#include <string>
#include <vector>

namespace sikku {
namespace {

const std::string bush =
    "title: Bush\nangle increment: 22.5\nturn: left\nsymbols: A S L\naxiom: A\nderivation length: 4\n"
    "stroke: 0.1 step #5a4632\npalette: #5a4632 #2f7d32\n"
    "A --> [&FL!A]/////[&FL!A]///////[&FL!A]\nF --> S/////F\nS --> FL\nL --> [;^^{-f+f+f-|-f+f+f}]\n";

class Growth : public ::testing::Test {
protected:
    Growth() { folder_.write("bush.lsys", bush); }
    Outcome draw(std::vector<std::string> arguments, const std::string& file) {
        arguments.insert(arguments.begin(), {"--quiet", "draw"});
        arguments.insert(arguments.end(), {"-o", file});
        Surroundings here;
        here.folder = folder_.path();
        return run(arguments, here);
    }
    void expect_refused(const Outcome& outcome, int status, const std::string& message) {
        EXPECT_EQ(outcome.status, status) << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, message));
    }
    ScratchFolder folder_;
};

TEST_F(Growth, FramesAreFilesInTheSamePlace) {
    ASSERT_EQ(draw({"hilbert", "--generations", "0:10", "--frames"}, "h.svg").status, 0);
    EXPECT_EQ(frame_file("a/h.svg", 3, 10), std::filesystem::path("a/h-03.svg"));
    std::set<std::string> paths;
    for (int n = 1; n <= 10; ++n) {
        pugi::xml_document document;
        const std::string name = frame_file("h.svg", n, 10).string();
        ASSERT_TRUE(document.load_file((folder_ / name).c_str())) << name;
        paths.insert(document.select_node("//path").node().attribute("d").value());
    }
    EXPECT_EQ(paths.size(), 10u);
    EXPECT_TRUE(has(contents(folder_ / "h-03.svg"), "-n 3")) << "each tells its own";
    EXPECT_TRUE(std::filesystem::exists(folder_ / "h-00.svg")) << "n = 0 draws nothing, and is a page";
    EXPECT_FALSE(std::filesystem::exists(folder_ / "h.svg"));
    // A step is as long in all of them: the last fills the page, and the first is as small as it is beside it.
    const auto length = [&](const std::string& name) {
        pugi::xml_document document;
        document.load_file((folder_ / name).c_str());
        return std::string(document.select_node("//path").node().attribute("d").value()).size();
    };
    EXPECT_LT(length("h-01.svg"), length("h-10.svg") / 1000);
}

TEST_F(Growth, TheLastFrameIsThePrintThatStandsAlone) {
    ASSERT_EQ(draw({"bush.lsys", "--generations", "2:4", "--frames", "--dpi", "40"}, "g.png").status, 0);
    ASSERT_EQ(draw({"bush.lsys", "-n", "4", "--dpi", "40"}, "alone.png").status, 0);
    NEEDS("iinfo");
    const auto pixels = [&](const std::string& name) {
        const std::string told = run("iinfo --hash '" + (folder_ / name).string() + "'").text;
        const std::size_t hash = told.find("SHA-1: ");
        return hash == std::string::npos ? std::string() : told.substr(hash);
    };
    EXPECT_NE(pixels("alone.png"), "");
    EXPECT_EQ(pixels("g-4.png"), pixels("alone.png")) << "where the last is the largest";
    EXPECT_NE(pixels("g-3.png"), pixels("alone.png"));
}

/// Of a GIF's frames, in hundredths of a second.
std::vector<int> delays(const std::string& bytes) {
    std::vector<int> list;
    for (std::size_t at = 0; (at = bytes.find("\x21\xf9\x04", at)) != std::string::npos; ++at) {
        list.push_back(static_cast<unsigned char>(bytes[at + 4]) + 256 * static_cast<unsigned char>(bytes[at + 5]));
    }
    return list;
}

TEST_F(Growth, TheEndOfAnAnimationIsHeld) {
    const std::vector<std::string> dragon = {"dragon", "--generations", "1:3", "--size", "20x20mm", "--dpi",
                                             "50",     "--margin",      "1mm"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), dragon.begin(), dragon.end());
        EXPECT_EQ(draw(more, "d.gif").status, 0);
        return delays(contents(folder_ / "d.gif"));
    };
    EXPECT_EQ(with({}), (std::vector{50, 50, 200}));
    EXPECT_EQ(with({"--hold", "4"}), (std::vector{50, 50, 400}));
    EXPECT_EQ(with({"--hold", "0.1", "--frame-time", "0.2"}), (std::vector{20, 20, 20}));
    EXPECT_EQ(with({"--frame-time", "3"}), (std::vector{300, 300, 300}));
    expect_refused(draw({"dragon", "--generations", "1:3", "--hold", "0"}, "d.gif"), 2,
                   "--hold 0: expected 0.01 to 600");
    expect_refused(draw({"dragon", "--hold", "1"}, "d.svg"), 2, "--hold");
    expect_refused(draw({"dragon", "--generations", "1:3", "--frames", "--hold", "1"}, "d.svg"), 2,
                   "applies only to a .gif");
}

TEST_F(Growth, EachFrameFitsThePageOnRequest) {
    // How wide the first path is, in micrometres.
    const auto start = [&](const std::string& name) {
        pugi::xml_document document;
        document.load_file((folder_ / name).c_str());
        const std::string d = document.select_node("//path").node().attribute("d").value();
        return d.substr(0, d.find_first_of("hvlcz"));
    };
    ASSERT_EQ(draw({"snake-kolam", "--generations", "0:4", "--frames", "--fit-frames"}, "fit.svg").status, 0);
    ASSERT_EQ(draw({"snake-kolam", "--generations", "0:4", "--frames"}, "still.svg").status, 0);
    for (const char* n : {"0", "4"}) {
        ASSERT_EQ(draw({"snake-kolam", "-n", n}, "alone.svg").status, 0);
        EXPECT_EQ(start(std::string("fit-") + n + ".svg"), start("alone.svg")) << n;
    }
    EXPECT_EQ(start("still-4.svg"), start("fit-4.svg"));
    EXPECT_NE(start("still-0.svg"), start("fit-0.svg"));
    // What draws nothing is an empty page all the same.
    EXPECT_EQ(
        draw({"hilbert", "--generations", "0:2", "--fit-frames", "--size", "20x20mm", "--margin", "1mm"}, "h.gif")
            .status,
        0);
    expect_refused(draw({"dragon", "--fit-frames"}, "d.svg"), 2, "--fit-frames");
}

TEST_F(Growth, GifHoldsAllGenerations) {
    for (const char* pattern : {"bush.lsys", "dragon"}) {
        ASSERT_EQ(draw({pattern, "--generations", "1:6", "--size", "40x30mm", "--margin", "2mm", "--dpi", "100",
                        "--frame-time", "0.25"},
                       "g.gif")
                      .status,
                  0);
        const std::string bytes = contents(folder_ / "g.gif");
        EXPECT_EQ(bytes.substr(0, 6), "GIF89a");
        EXPECT_EQ(bytes.back(), ';');
        EXPECT_TRUE(has(bytes, "NETSCAPE2.0")) << "over and over";
        // Graphic control extensions: delays in hundredths of a second.
        EXPECT_EQ(delays(bytes), (std::vector<int>{25, 25, 25, 25, 25, 200})) << "the last one is held";
        const std::string first = bytes;
        ASSERT_EQ(draw({pattern, "--generations", "1:6", "--size", "40x30mm", "--margin", "2mm", "--dpi", "100",
                        "--frame-time", "0.25", "-j", "1"},
                       "g.gif")
                      .status,
                  0);
        EXPECT_EQ(contents(folder_ / "g.gif"), first) << "the same bytes";
    }
}

TEST_F(Growth, APerspectiveStandsStill) {
    ASSERT_EQ(draw({"bush.lsys", "--generations", "1:4", "--frames", "--view", "20,30,perspective,2", "--dpi", "40"},
                   "p.svg")
                  .status,
              0);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "p-1.svg"));
}

TEST_F(Growth, ViewsDifferAndAreToldInThePrint) {
    ASSERT_EQ(draw({"bush.lsys", "--dpi", "40"}, "front.svg").status, 0);
    ASSERT_EQ(draw({"bush.lsys", "--view", "90,20"}, "side.svg").status, 0);
    EXPECT_NE(contents(folder_ / "front.svg"), contents(folder_ / "side.svg"));
    EXPECT_TRUE(has(contents(folder_ / "side.svg"), "--view 90,20"));
    ASSERT_EQ(draw({"bush.lsys", "--set", "view=90 20"}, "key.svg").status, 0);
    for (const char* file : {"b.pdf", "b.png", "b.tif", "b.hpgl", "b.gcode"}) {
        EXPECT_EQ(draw({"bush.lsys", "--view", "top", "--dpi", "30"}, file).status, 0) << file;
    }
    expect_refused(draw({"bush.lsys", "--view", "90"}, "x.svg"), 2, "expected AZIMUTH,ELEVATION in degrees");
    expect_refused(draw({"bush.lsys", "--set", "line=spline"}, "x.svg"), 2,
                   "--set:1:6: drawings in space have straight lines");
    expect_refused(draw({"bush.lsys", "--window", "0,0,1,1"}, "x.svg"), 2, "drawings in the plane");
    expect_refused(draw({"bush.lsys", "--dots"}, "x.svg"), 2, "drawings in the plane");
    expect_refused(draw({"bush.lsys", "--spot", "Leaf=#2f7d32"}, "x.pdf"), 2,
                   "more shades of light than there are inks");
    expect_refused(draw({"bush.lsys", "-n", "30"}, "x.png"), 1, "budget");
    expect_refused(draw({"bush.lsys", "-n", "14"}, "x.glb"), 1, "up to n = ");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.svg"));
    expect_refused(run({"kolam", (folder_ / "bush.lsys").string()}), 1, "a kolam lies in the plane");
}

TEST_F(Growth, ModelsAreMade) {
    for (const char* file : {"b.obj", "b.glb"}) EXPECT_EQ(draw({"bush.lsys"}, file).status, 0) << file;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "b.mtl"));
    EXPECT_EQ(draw({"dragon"}, "d.glb").status, 0) << "of the plane, too";
    expect_refused(draw({"snake-kolam"}, "s.glb"), 2, "models have straight lines, not splines");
    expect_refused(draw({"bush.lsys", "--view", "top"}, "v.glb"), 2, "a model has no page");
    expect_refused(draw({"bush.lsys"}, "missing/v.glb"), 1, "missing");
    folder_.write("none.lsys", "axiom: X\nX --> XX\nderivation length: 3\n");
    expect_refused(draw({"none.lsys"}, "w.obj"), 1, "nothing to draw");
}

TEST_F(Growth, BadGenerationsAreRefused) {
    expect_refused(draw({"dragon"}, "d.gif"), 2, "--generations: required for a .gif");
    expect_refused(draw({"dragon", "--frames"}, "d.png"), 2, "needs --generations");
    expect_refused(draw({"dragon", "--generations", "4:1"}, "d.gif"), 2, "the lowest first");
    expect_refused(draw({"dragon", "--generations", "1:x"}, "d.gif"), 2, "expected two derivation lengths");
    expect_refused(draw({"dragon", "--generations", "1:3", "--frame-time", "0"}, "d.gif"), 2, "--frame-time");
    expect_refused(draw({"dragon", "--generations", "1:60"}, "d.gif"), 1, "budget");
    expect_refused(draw({"dragon", "--generations", "1:3", "--size", "10000x1000mm", "--dpi", "155"}, "d.gif"), 2,
                   "100 million");
    expect_refused(draw({"dragon", "--frame-time", "1"}, "d.png"), 2, "applies only to a .gif");
    expect_refused(draw({"dragon", "--frame-time", "1"}, "d.obj"), 2, "a model has no page");
    folder_.write("none.lsys", "axiom: X\nX --> XX\nderivation length: 3\n");
    expect_refused(draw({"none.lsys", "--generations", "1:3"}, "d.gif"), 1, "none of these generations draws");
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"bush.lsys", "none.lsys"}));
}

}  // namespace
}  // namespace sikku
