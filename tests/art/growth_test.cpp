// tests/art/growth_test.cpp: animations, views and models of prints.
#include "art/motion/growth.h"

#include "art/prints.h"
#include "tests/files.h"
#include "tests/tools.h"
#include "tests/works.h"

#include <pugixml.hpp>

#include <set>
#include <string>
#include <vector>

namespace sikku::growth_test {

const std::string bush =
    "title: Bush\nangle increment: 22.5\nturn: left\nsymbols: A S L\naxiom: A\nderivation length: 4\n"
    "stroke: 0.1 step #5a4632\npalette: #5a4632 #2f7d32\n"
    "A --> [&FL!A]/////[&FL!A]///////[&FL!A]\nF --> S/////F\nS --> FL\nL --> [;^^{-f+f+f-|-f+f+f}]\n";

class Growth : public ::testing::Test {
protected:
    /// Draws a bundled pattern, or one of these, and keeps the files.
    MadeWork draw(const std::string& pattern, const OptionValues& values, const std::string& file, int threads = 0) {
        const std::string format = file.substr(file.rfind('.') + 1);
        MadeWork made = made_work([&](MemoryDestination& memory) {
            const Document document = pattern == "bush"   ? parse("bush.lsys", bush)
                                      : pattern == "none" ? parse("none.lsys", "axiom: X\nX --> XX\n")
                                                          : load(pattern);
            const Assignment assigned = assign(prints(), document, values);
            return prints().plan(assigned.document, format, assigned.options)->make(memory, file, {}, threads);
        });
        for (const auto& [name, bytes] : made.outputs) files_[name] = bytes;
        return made;
    }
    /// The first path of an SVG.
    std::string path(const std::string& name) {
        pugi::xml_document document;
        EXPECT_TRUE(document.load_string(files_.at(name).c_str())) << name;
        return document.select_node("//path").node().attribute("d").value();
    }
    std::map<std::string, std::string> files_;
};

TEST_F(Growth, FramesAreFilesInTheSamePlace) {
    ASSERT_EQ(draw("hilbert", {{"generations", "0:10"}, {"frames", "true"}}, "h.svg").error, "");
    EXPECT_EQ(frame_file("a/h.svg", 3, 10), std::filesystem::path("a/h-03.svg"));
    std::set<std::string> paths;
    for (int n = 1; n <= 10; ++n) paths.insert(path(frame_file("h.svg", n, 10).string()));
    EXPECT_EQ(paths.size(), 10u);
    EXPECT_TRUE(has(files_.at("h-03.svg"), "--generations 0:10 --frames # n = 3"));
    EXPECT_TRUE(files_.contains("h-00.svg")) << "n = 0 draws nothing, and is a page";
    EXPECT_FALSE(files_.contains("h.svg"));
    // A step is as long in all of them: the last fills the page, and the first is as small as it is beside it.
    EXPECT_LT(path("h-01.svg").size(), path("h-10.svg").size() / 1000);
}

TEST_F(Growth, TheLastFrameIsThePrintThatStandsAlone) {
    NEEDS("iinfo");
    ASSERT_EQ(draw("bush", {{"generations", "2:4"}, {"frames", "true"}, {"dpi", "40"}}, "g.png").error, "");
    ASSERT_EQ(draw("bush", {{"n", "4"}, {"dpi", "40"}}, "alone.png").error, "");
    const ScratchFolder folder;
    const auto pixels = [&](const std::string& name) {
        const std::string told = run_tool("iinfo --hash '" + folder.write(name, files_.at(name)) + "'").text;
        const std::size_t hash = told.find("SHA-1: ");
        return hash == std::string::npos ? std::string() : told.substr(hash);
    };
    EXPECT_NE(pixels("alone.png"), "");
    EXPECT_EQ(pixels("g-4.png"), pixels("alone.png")) << "where the last is the largest";
    EXPECT_NE(pixels("g-3.png"), pixels("alone.png"));
}

/// The display times of the frames of a GIF, in hundredths of a second.
std::vector<int> delays(const std::string& bytes) {
    std::vector<int> list;
    for (std::size_t at = 0; (at = bytes.find("\x21\xf9\x04", at)) != std::string::npos; ++at) {
        list.push_back(static_cast<unsigned char>(bytes[at + 4]) + 256 * static_cast<unsigned char>(bytes[at + 5]));
    }
    return list;
}

TEST_F(Growth, TheEndOfAnAnimationIsHeld) {
    const auto with = [&](OptionValues values) {
        values.insert(values.end(), {{"generations", "1:3"}, {"size", "20x20mm"}, {"dpi", "50"}, {"margin", "1mm"}});
        return delays(draw("dragon", values, "d.gif").bytes());
    };
    EXPECT_EQ(with({}), (std::vector{50, 50, 200}));
    EXPECT_EQ(with({{"hold", "4"}}), (std::vector{50, 50, 400}));
    EXPECT_EQ(with({{"hold", "0.1"}, {"frame-time", "0.2"}}), (std::vector{20, 20, 20}));
    EXPECT_EQ(with({{"frame-time", "3"}}), (std::vector{300, 300, 300}));
}

TEST_F(Growth, EachFrameFitsThePageOnRequest) {
    const OptionValues frames = {{"generations", "0:4"}, {"frames", "true"}};
    OptionValues fitting = frames;
    fitting.push_back({"fit-frames", "true"});
    // How wide the first path is, in micrometres.
    const auto start = [&](const std::string& name) {
        const std::string d = path(name);
        return d.substr(0, d.find_first_of("hvlcz"));
    };
    ASSERT_EQ(draw("snake-kolam", fitting, "fit.svg").error, "");
    ASSERT_EQ(draw("snake-kolam", frames, "still.svg").error, "");
    for (const std::string n : {"0", "4"}) {
        ASSERT_EQ(draw("snake-kolam", {{"n", n}}, "alone.svg").error, "");
        EXPECT_EQ(start("fit-" + n + ".svg"), start("alone.svg")) << n;
    }
    EXPECT_EQ(start("still-4.svg"), start("fit-4.svg"));
    EXPECT_NE(start("still-0.svg"), start("fit-0.svg"));
    // A generation that draws nothing is an empty page.
    const OptionValues small = {
        {"generations", "0:2"}, {"fit-frames", "true"}, {"size", "20x20mm"}, {"margin", "1mm"}};
    EXPECT_EQ(draw("hilbert", small, "h.gif").error, "");
}

TEST_F(Growth, GifHoldsAllGenerations) {
    const OptionValues values = {
        {"generations", "1:6"}, {"size", "40x30mm"}, {"margin", "2mm"}, {"dpi", "100"}, {"frame-time", "0.25"}};
    for (const char* pattern : {"bush", "dragon"}) {
        const std::string bytes = draw(pattern, values, "g.gif").bytes();
        EXPECT_EQ(bytes.substr(0, 6), "GIF89a");
        EXPECT_EQ(bytes.back(), ';');
        EXPECT_TRUE(has(bytes, "NETSCAPE2.0")) << "over and over";
        // Graphic control extensions: delays in hundredths of a second.
        EXPECT_EQ(delays(bytes), (std::vector<int>{25, 25, 25, 25, 25, 200})) << "the last one is held";
        EXPECT_EQ(draw(pattern, values, "g.gif", 1).bytes(), bytes) << "the same bytes";
    }
}

TEST_F(Growth, ViewsDifferAndAreToldInThePrint) {
    ASSERT_EQ(draw("bush", {{"dpi", "40"}}, "front.svg").error, "");
    ASSERT_EQ(draw("bush", {{"view", "90,20"}}, "side.svg").error, "");
    EXPECT_NE(files_.at("front.svg"), files_.at("side.svg"));
    EXPECT_TRUE(has(files_.at("side.svg"), "--view 90,20"));
    ASSERT_EQ(draw("bush", {{"view", "90 20"}}, "key.svg").error, "");
    for (const char* file : {"b.pdf", "b.png", "b.tif", "b.hpgl", "b.gcode"}) {
        EXPECT_EQ(draw("bush", {{"view", "top"}, {"dpi", "30"}}, file).error, "") << file;
    }
    // A perspective stands still.
    const OptionValues moving = {
        {"generations", "1:4"}, {"frames", "true"}, {"view", "20,30,perspective,2"}, {"dpi", "40"}};
    ASSERT_EQ(draw("bush", moving, "p.svg").error, "");
    EXPECT_TRUE(files_.contains("p-1.svg"));
}

TEST_F(Growth, ModelsAreMade) {
    for (const char* file : {"b.obj", "b.glb"}) EXPECT_EQ(draw("bush", {}, file).error, "") << file;
    EXPECT_TRUE(files_.contains("b.mtl"));
    EXPECT_EQ(draw("dragon", {}, "d.glb").error, "") << "of the plane, too";
    const ScratchFolder folder;
    EXPECT_TRUE(has(error_of([&] {
                        prints().plan(parse("b", bush), "glb", {})->make(file_system(), folder / "missing/v.glb", {});
                    }),
                    "missing"));
}

TEST_F(Growth, WhatCannotBeDrawnIsRefused) {
    struct Refusal {
        std::string pattern;
        OptionValues values;
        std::string file;
        int status;
        std::string message;
    };
    const std::vector<Refusal> refusals = {
        {"dragon", {}, "d.gif", 2, "generations: required for a .gif"},
        {"dragon", {{"frames", "true"}}, "d.png", 2, "needs 'generations'"},
        {"dragon", {{"generations", "4:1"}}, "d.gif", 2, "the lowest first"},
        {"dragon", {{"generations", "1:x"}}, "d.gif", 2, "expected two derivation lengths"},
        {"dragon", {{"generations", "1:3"}, {"frame-time", "0"}}, "d.gif", 2, "frame-time"},
        {"dragon", {{"generations", "1:60"}}, "d.gif", 1, "budget"},
        {"dragon", {{"generations", "1:3"}, {"size", "10000x1000mm"}, {"dpi", "155"}}, "d.gif", 2, "100 million"},
        {"dragon", {{"frame-time", "1"}}, "d.png", 2, "applies only to a .gif"},
        {"dragon", {{"frame-time", "1"}}, "d.obj", 2, "a model has no page"},
        {"dragon", {{"generations", "1:3"}, {"hold", "0"}}, "d.gif", 2, "hold 0: expected 0.01 to 600"},
        {"dragon", {{"hold", "1"}}, "d.svg", 2, "hold"},
        {"dragon", {{"generations", "1:3"}, {"frames", "true"}, {"hold", "1"}}, "d.svg", 2, "applies only to a .gif"},
        {"dragon", {{"fit-frames", "true"}}, "d.svg", 2, "fit-frames"},
        {"none", {{"generations", "1:3"}}, "d.gif", 1, "none of these generations draws"},
        {"none", {{"n", "3"}}, "w.obj", 1, "nothing to draw"},
        {"snake-kolam", {}, "s.glb", 2, "models have straight lines, not splines"},
        {"bush", {{"view", "top"}}, "v.glb", 2, "a model has no page"},
        {"bush", {{"view", "90"}}, "x.svg", 2, "expected AZIMUTH,ELEVATION in degrees"},
        {"bush", {{"line", "spline"}}, "x.svg", 2, "drawings in space have straight lines"},
        {"bush", {{"window", "0,0,1,1"}}, "x.svg", 2, "drawings in the plane"},
        {"bush", {{"dots", ""}}, "x.svg", 2, "drawings in the plane"},
        {"bush", {{"spot", "Leaf=#2f7d32"}}, "x.pdf", 2, "more shades of light than there are inks"},
        {"bush", {{"n", "30"}}, "x.png", 1, "budget"},
        {"bush", {{"n", "14"}}, "x.glb", 1, "up to n = "}};
    for (const auto& [pattern, values, file, status, message] : refusals) {
        EXPECT_TRUE(is_refused(draw(pattern, values, file), status, message)) << pattern << ' ' << file;
    }
}

}  // namespace sikku::growth_test
