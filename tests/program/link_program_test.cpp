// tests/program/link_program_test.cpp: studio links instead of patterns. The program and the studio's libraries make
// the same bytes from them.
#include "art/link/link.h"
#include "studio/bridge.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace sikku::link_program_test {

using Json = nlohmann::ordered_json;

struct Answer {
    Json json;
    std::string bytes;
};

/// Asks the libraries as the page of the studio does.
Answer ask(const Json& question) {
    Reply reply = request(question.dump(), "");
    return {Json::parse(reply.json), std::move(reply.bytes)};
}

std::string text_of_pattern(const std::string& name) {
    return load(name).source().text();
}

Json pairs(const OptionValues& values) {
    Json list = Json::array();
    for (const OptionValue& value : values) list.push_back(Json::array({value.name, value.text}));
    return list;
}

Json shared(const std::string& name, const OptionValues& settings, const OptionValues& draw, const OptionValues& play,
            const std::string& variant = "") {
    const Json pattern = {{"name", name + ".lsys"},
                          {"text", text_of_pattern(name)},
                          {"variant", variant},
                          {"settings", pairs(settings)}};
    return {{"pattern", pattern}, {"draw", pairs(draw)}, {"play", pairs(play)}, {"page", {{"panel", "map"}}}};
}

std::string link_to(const Json& work) {
    const Answer answer = ask({{"do", "link"}, {"shared", work}});
    EXPECT_TRUE(answer.json.contains("link")) << answer.json;
    return "https://example.org/sikku-studio.html#" + answer.json["link"].get<std::string>();
}

std::string made(const Json& work, const char* interpreter, const std::string& format) {
    const Answer answer = ask({{"do", "make"},
                               {"interpreter", interpreter},
                               {"format", format},
                               {"options", work[interpreter]},
                               {"pattern", work["pattern"]}});
    EXPECT_FALSE(answer.json.contains("error")) << answer.json;
    return answer.bytes;
}

TEST(LinkProgram, TheStudioAndTheProgramMakeTheSameBytes) {
    const ScratchFolder folder;
    const std::vector<Json> works = {
        shared("snake-kolam", {}, {}, {}),
        shared("snake-kolam", {{"derivation length", "3"}, {"stroke", "0.3 step navy"}},
               {{"size", "A3"}, {"landscape", "true"}, {"dots", ""}, {"border", "kaavi"}}, {}),
        shared("hilbert", {{"seed", "7"}, {"derivation length", "5"}, {"scale", "blues"}},
               {{"window", "-1.5,0,10,8.25"}, {"margin", "0mm"}},
               {{"humanise", "0.5"}, {"tempo", "90"}, {"bars", "4"}}),
        shared("honda-trees", {{"derivation length", "6"}}, {{"mirror", "true"}}, {}, "b"),
        shared("bush-3d", {{"derivation length", "4"}}, {{"view", "30,15,perspective"}}, {}),
        shared("stochastic-branches", {{"seed", "12"}}, {{"rotate", "17"}, {"stroke", "0.4mm #123456"}},
               {{"seed", "5"}, {"humanise", "1"}}),
        // Options may name keys of the pattern.
        shared("koch-island", {}, {{"angle factor", "6"}, {"derivation length", "2"}}, {}),
    };
    for (const Json& work : works) {
        SCOPED_TRACE(work["pattern"]["name"]);
        const std::string link = link_to(work);
        for (const std::string format : {"svg", "pdf", "gcode"}) {
            if (format == "gcode" && work["draw"].dump().find("window") != std::string::npos) continue;
            const Outcome outcome = run({"-q", "draw", link, "-o", folder.file("x." + format)});
            EXPECT_EQ(outcome.status, 0) << outcome.errors;
            EXPECT_TRUE(contents(folder / ("x." + format)) == made(work, "draw", format)) << format;
        }
        if (work["pattern"]["name"] != "hilbert.lsys") continue;
        for (const std::string format : {"mid", "musicxml", "ly"}) {
            const Outcome outcome = run({"-q", "play", link, "-o", folder.file("x." + format)});
            EXPECT_EQ(outcome.status, 0) << outcome.errors;
            EXPECT_TRUE(contents(folder / ("x." + format)) == made(work, "play", format)) << format;
        }
    }
}

TEST(LinkProgram, ACommandWithTheSameOptionsMakesTheSameBytes) {
    const ScratchFolder folder;
    const std::string link =
        link_to(shared("hilbert", {{"derivation length", "4"}, {"seed", "7"}, {"angle factor", "4"}},
                       {{"size", "A5"}}, {{"humanise", "0.5"}}));
    const auto same = [&](std::vector<std::string> one, std::vector<std::string> other, const std::string& format) {
        for (auto* arguments : {&one, &other}) {
            const std::string name = (arguments == &one ? "one." : "other.") + format;
            arguments->insert(arguments->end(), {"-q", "-o", folder.file(name)});
            const Outcome outcome = run(*arguments);
            EXPECT_EQ(outcome.status, 0) << outcome.errors;
        }
        EXPECT_EQ(contents(folder / ("one." + format)), contents(folder / ("other." + format)));
    };
    same({"draw", link}, {"draw", "hilbert", "-n", "4", "--seed", "7", "--set", "angle factor=4", "--size", "A5"},
         "svg");
    same({"play", link},
         {"play", "hilbert", "-n", "4", "--seed", "7", "--set", "angle factor=4", "--humanise", "0.5"}, "mid");
    // The command line takes precedence.
    same({"draw", link, "-n", "3", "--seed", "8", "--set", "angle factor=6", "--size", "A4"},
         {"draw", "hilbert", "-n", "3", "--seed", "8", "--set", "angle factor=6", "--size", "A4"}, "svg");
    same({"play", link, "-n", "3", "--seed", "8", "--humanise", "0.2"},
         {"play", "hilbert", "-n", "3", "--seed", "8", "--set", "angle factor=4", "--humanise", "0.2"}, "mid");
    same({"draw", link, "--generations", "1:3"},
         {"draw", "hilbert", "--seed", "7", "--set", "angle factor=4", "--size", "A5", "--generations", "1:3"},
         "svg");
}

TEST(LinkProgram, EveryCommandReadsLinks) {
    const Json work = shared("koch-island", {{"derivation length", "1"}}, {{"size", "A5"}}, {});
    const std::string link = link_to(work);
    const std::string fragment = link.substr(link.find('#') + 1);
    EXPECT_EQ(run({"derive", link}).output, run({"derive", "koch-island", "-n", "1"}).output);
    EXPECT_EQ(run({"derive", link, "-n", "2"}).output, run({"derive", "koch-island", "-n", "2"}).output);
    EXPECT_EQ(run({"measure", fragment, "--json"}).output,
              run({"measure", "koch-island", "-n", "1", "--json"}).output);
    EXPECT_EQ(run({"kolam", '#' + fragment, "--json"}).output,
              run({"kolam", "koch-island", "-n", "1", "--json"}).output);
    EXPECT_EQ(run({"check", link}).status, 0);
    const Outcome shown = run({"show", link});
    EXPECT_EQ(shown.output, text_of_pattern("koch-island"));
    EXPECT_EQ(shown.errors, "the link sets derivation length 1; draw: size A5\n");
    EXPECT_EQ(run({"show", link, "-q"}).errors, "");
    const Outcome several = run({"play", link, "hilbert"});
    EXPECT_EQ(several.status, 0) << several.errors;
}

TEST(LinkProgram, LinksSetNeitherCommandsForMachinesNorFiles) {
    const ScratchFolder folder;
    folder.write("frame.lsys", "title: a secret\naxiom: [\n");
    const auto draw = [&](const Json& work, const std::string& name, const std::vector<std::string>& more = {}) {
        std::filesystem::remove(folder / name);
        std::vector<std::string> arguments = {"-q", "draw", link_to(work), "-o", name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments, {.folder = folder.path()});
    };
    const auto refused = [&](const Outcome& outcome, std::string_view message) {
        EXPECT_EQ(outcome.status, 2) << message;
        EXPECT_TRUE(has(outcome.errors, message));
        EXPECT_FALSE(has(outcome.errors, "secret"));
    };
    const Json commands = shared("hilbert", {}, {{"gcode-start", "M3 S1000\nG0 X999 Y999 Z-50"}}, {});
    refused(draw(commands, "x.gcode"),
            "sikku: the link sets commands for a plotter: gcode-start 'M3 S1000 G0 X999 Y999 Z-50'; --trust-link "
            "allows it, and --gcode-start replaces it\n");
    EXPECT_FALSE(std::filesystem::exists(folder / "x.gcode"));
    EXPECT_EQ(draw(commands, "x.gcode", {"--trust-link"}).status, 0);
    EXPECT_TRUE(has(contents(folder / "x.gcode"), "\nG0 X999 Y999 Z-50\n"));
    EXPECT_EQ(draw(commands, "x.gcode", {"--gcode-start", "G21"}).status, 0);
    EXPECT_FALSE(has(contents(folder / "x.gcode"), "X999"));
    for (const OptionValue& option :
         OptionValues{{"pen", "1 down=-50mm"}, {"park", "9m,9m"}, {"refill", "1m@1m,1m"}}) {
        refused(draw(shared("hilbert", {}, {option}, {}), "x.gcode"), "the link sets commands for a plotter");
    }
    for (const OptionValue& option : OptionValues{{"border", "frame.lsys"},
                                                  {"border", "kaavi,/etc/frame.lsys"},
                                                  {"profile", "./frame.lsys"},
                                                  {"cmyk", "frame.lsys"},
                                                  {"surface", "a = frame.s"}}) {
        refused(draw(shared("hilbert", {}, {option}, {}), option.name == "profile" ? "x.gcode" : "x.pdf"),
                "the link names a file of this machine: " + option.name);
    }
    // The same as a setting, in the text, and in a variant that is chosen.
    const std::string names_file = "names a file of this machine: ";
    const Json setting = shared("hilbert", {{"border", "frame.lsys"}}, {}, {});
    refused(draw(setting, "x.svg"), names_file + "border 'frame.lsys'");
    EXPECT_EQ(draw(setting, "x.svg", {"--set", "border=none"}).status, 0);
    Json work = shared("hilbert", {}, {}, {});
    for (const char* line :
         {"border: frame.lsys", "surface: a = frame.s", "scale: frame.scl", "keyboard: frame.kbm"}) {
        work["pattern"]["text"] = std::string("axiom: F\nF --> F+F\nangle factor: 4\n") + line + "\n";
        refused(draw(work, "x.svg"), "the pattern of the link " + names_file);
        refused(run({"check", link_to(work)}), names_file);
        refused(run({"measure", link_to(work)}), names_file);
        EXPECT_EQ(run({"show", link_to(work)}).status, 0);
    }
    work["pattern"]["text"] = "axiom: F\nF --> F+F\nangle factor: 4\nvariant far: border = frame.lsys\n";
    EXPECT_EQ(draw(work, "x.svg").status, 0);
    refused(draw(work, "x.svg", {"--variant", "far"}), names_file);
    refused(run({"check", link_to(work)}), names_file);
    work["pattern"]["text"] = "axiom: F\nborder: frame.lsys\n";
    refused(run({"sheet", link_to(work), "-o", folder.file("x.svg")}), names_file);
    refused(run({"play", link_to(shared("hilbert", {}, {}, {{"scale", "frame.scl"}}))}), names_file);
    // Links may set the look, also by options whose other values are files.
    EXPECT_EQ(draw(shared("hilbert", {}, {{"border", "kaavi"}}, {}), "x.svg").status, 0);
    EXPECT_EQ(draw(shared("hilbert", {}, {{"pen-width", "0.5mm"}}, {}), "x.gcode").status, 0);
    // A bundled profile may turn a laser on, and speeds are those of a machine.
    for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{
             {"profile", "grbl-laser"}, {"pen-speed", "10000"}, {"lift-time", "3600"}, {"resume", "1m"}}) {
        refused(draw(shared("hilbert", {}, {{name, value}}, {}), "x.gcode"), "the link sets commands for a plotter");
    }
    EXPECT_EQ(run({"play", link_to(shared("hilbert", {}, {}, {{"scale", "dorian"}}))}).status, 0);
}

TEST(LinkProgram, TheStudioLeavesOutCommandsForMachines) {
    const Json work = shared("hilbert", {}, {{"size", "A5"}, {"gcode-end", "M3"}, {"pen", "1 down=-9"}}, {});
    const Answer answer = ask({{"do", "read_link"}, {"link", link_to(work)}});
    EXPECT_EQ(answer.json["withheld"], pairs({{"gcode-end", "M3"}, {"pen", "1 down=-9"}}));
    EXPECT_EQ(answer.json["shared"]["draw"], pairs({{"size", "A5"}}));
}

TEST(LinkProgram, ValuesOfLinksAreOneLine) {
    const Json work = shared("hilbert", {{"title", "a\nsikku: done\u2028b"}}, {{"title-line", "c\r\nd"}}, {});
    EXPECT_EQ(run({"show", link_to(work)}).errors, "the link sets title a sikku: done b; draw: title-line c  d\n");
}

TEST(LinkProgram, FaultsAreReported) {
    const ScratchFolder folder;
    const std::string out = folder.file("x.svg");
    const std::string link = link_to(shared("hilbert", {}, {{"window", "0,0,9,9"}}, {}));
    const auto refused = [&](const std::vector<std::string>& arguments, std::string_view message) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2) << message;
        EXPECT_TRUE(has(outcome.errors, message));
        EXPECT_EQ(outcome.output, "");
    };
    for (const char* command : {"measure", "kolam", "derive", "show", "check"}) {
        refused({command, link.substr(0, link.size() - 5)}, "sikku: the link is damaged");
    }
    refused({"draw", "https://example.org/", "-o", out}, "sikku: this address contains no pattern");
    refused({"play", "sikku2.AAAA"}, "sikku: this link was made by a newer version of Sikku");
    refused({"draw", link, "-o", folder.file("x.gcode")},
            "--window: a window would cut the strokes of a plot (the link sets this option)");
    Json work = shared("hilbert", {{"angle", "x"}}, {{"nonsense", "1"}}, {});
    refused({"draw", link_to(work), "-o", out}, "link --set:1:1: unknown key 'angle'");
    work["pattern"]["settings"] = Json::array();
    refused({"draw", link_to(work), "-o", out}, "--nonsense: unknown option or key (the link sets this option)");
    work["pattern"]["text"] = "axiom: F\nF -> F\n";
    refused({"draw", link_to(work), "-o", out}, "hilbert.lsys:2:");
    EXPECT_FALSE(std::filesystem::exists(out));
    // A file of that name takes precedence.
    folder.write("sikku1.file", "axiom: F\n");
    EXPECT_EQ(run({"derive", "sikku1.file"}, {.folder = folder.path()}).output, "F\n");
}

TEST(LinkProgram, TheStudioReadsItsLinks) {
    const Json work = shared("hilbert", {{"seed", "7"}}, {{"size", "A3"}}, {{"tempo", "90"}});
    const std::string link = link_to(work);
    EXPECT_EQ(ask({{"do", "read_link"}, {"link", link}}).json["shared"], work);
    const Json error = ask({{"do", "read_link"}, {"link", link + "A"}}).json["error"];
    EXPECT_EQ(error["kind"], "other");
    for (const Json& bad :
         {Json{{"do", "link"}}, Json{{"do", "link"}, {"shared", 3}},
          Json{{"do", "link"}, {"shared", {{"pattern", {{"name", "a"}}}}}}, Json{{"do", "read_link"}, {"link", 3}}}) {
        EXPECT_EQ(ask(bad).json["error"]["kind"], "request") << bad;
    }
}

}  // namespace sikku::link_program_test
