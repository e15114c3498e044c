#include "studio/bridge.h"
#include "tests/checks.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

namespace sikku::bridge_test {

using Json = nlohmann::ordered_json;

Json asked(const Json& question, const std::string& bytes = {}) {
    return Json::parse(request(question.dump(), bytes).json);
}

std::string kind_of_failure(const Json& question, const std::string& bytes = {}) {
    const Json answer = asked(question, bytes);
    return answer.contains("error") ? answer["error"]["kind"].get<std::string>() : "";
}

/// Pairs of texts, which would otherwise become an object.
Json pairs(std::initializer_list<std::pair<const char*, const char*>> texts) {
    Json list = Json::array();
    for (const auto& [name, value] : texts) list.push_back(Json::array({name, value}));
    return list;
}

Json pattern(const std::string& text, const Json& settings = Json::array()) {
    return {{"name", "test.lsys"}, {"text", text}, {"settings", settings}};
}

const std::string koch = "axiom: F--F--F\nangle factor: 6\nderivation length: 3\nF --> F+F--F+F\n";

TEST(Bridge, RefusesWhatIsNotARequest) {
    for (const char* text :
         {"", "{", "[]", "3", "\"open\"", "{}", R"({"do": 3})", R"({"do": "fly"})", R"({"do": "open"})",
          R"({"do": "open", "pattern": 3})", R"({"do": "open", "pattern": {"text": "axiom: F"}})",
          R"({"do": "open", "pattern": {"name": "x", "text": 3}})",
          R"({"do": "open", "pattern": {"name": "x", "text": "axiom: F", "settings": [["n"]]}})",
          R"({"do": "open", "pattern": {"name": "x", "text": "axiom: F", "settings": {"n": 1}}})",
          R"({"do": "make", "interpreter": "fly", "format": "svg"})"}) {
        const Reply reply = request(text, {});
        EXPECT_EQ(Json::parse(reply.json)["error"]["kind"], "request") << text << reply.json;
        EXPECT_TRUE(reply.bytes.empty());
    }
}

TEST(Bridge, ReportsEveryKindOfFailure) {
    EXPECT_EQ(kind_of_failure({{"do", "open"}, {"pattern", pattern("angel: 3\n")}}), "pattern");
    EXPECT_EQ(kind_of_failure({{"do", "open"}, {"pattern", pattern(koch, pairs({{"no key", "1"}}))}}), "pattern");
    const Json make = {{"do", "make"}, {"interpreter", "draw"}, {"format", "svg"}, {"pattern", pattern(koch)}};
    Json question = make;
    question["options"] = pairs({{"size", "3x"}});
    EXPECT_EQ(kind_of_failure(question), "setting");
    EXPECT_EQ(asked(question)["error"]["option"], "size");
    question = make;
    question["pattern"] = pattern(koch, pairs({{"derivation length", "99"}}));
    EXPECT_EQ(kind_of_failure(question), "budget");
    question["pattern"] = pattern("axiom: F]\n");
    EXPECT_EQ(kind_of_failure(question), "word");
    question["pattern"] = pattern("axiom: X\n");
    EXPECT_EQ(kind_of_failure(question), "other");
    question = make;
    question["seconds"] = 0;
    question["pattern"] = pattern(koch, pairs({{"derivation length", "11"}}));
    EXPECT_EQ(kind_of_failure(question), "stopped");
}

TEST(Bridge, AnswersEditors) {
    const Json text = {{"uri", "test.lsys"}, {"text", "axiom: 𝄞X\nX --> F𝄞X\n"}};
    const auto ask = [&](const char* method, const Json& place, const char* name = "Q") {
        return asked({{"do", "editor"},
                      {"method", std::string("textDocument/") + method},
                      {"parameters", {{"textDocument", text}, {"position", place}, {"newName", name}}}});
    };
    const Json place = {{"line", 0}, {"character", 9}};
    const std::string help = ask("hover", place)["result"]["contents"]["value"];
    EXPECT_NE(help.find("`X --> F𝄞X` (line 2)"), std::string::npos) << help;
    EXPECT_EQ(ask("definition", place)["result"][0]["range"]["start"]["line"], 1);
    EXPECT_EQ(ask("rename", place)["result"]["changes"]["test.lsys"].size(), 3u);
    EXPECT_EQ(ask("rename", place, "F")["error"]["kind"], "other");
    EXPECT_TRUE(ask("hover", {{"line", 7}, {"character", 0}})["result"].is_null());
    EXPECT_EQ(ask("fly", place)["error"]["kind"], "request");
    EXPECT_EQ(ask("hover", {{"line", 0}})["error"]["kind"], "request");
}

TEST(Bridge, PlacesOfErrorsCountCodePoints) {
    const Json answer = asked({{"do", "open"}, {"pattern", pattern("axiom: éF(\n")}});
    const Json& first = answer["error"]["diagnostics"][0];
    EXPECT_EQ(first["line"], 1);
    EXPECT_EQ(first["column"], 10);
    EXPECT_EQ(first["warning"], false);
}

TEST(Bridge, OpensWordsTooLongToDerive) {
    const Json answer = asked({{"do", "open"}, {"pattern", pattern(koch, pairs({{"derivation length", "60"}}))}});
    EXPECT_EQ(answer["cost"]["is_derivable"], false);
    EXPECT_EQ(answer["cost"]["segments"], "3987683987354747618711421180841033728");  // 3 * 4^60
    EXPECT_EQ(answer["has_view"], true);
    EXPECT_EQ(answer["extent"].size(), 4U);
}

TEST(Bridge, PixelsAreLimited) {
    const Json picture = {{"do", "pixels"}, {"pattern", pattern(koch)}, {"width", 100}, {"height", 80}};
    const Reply reply = request(picture.dump(), {});
    const Json answer = Json::parse(reply.json);
    EXPECT_EQ(reply.bytes.size(), 4 * answer["width"].get<std::size_t>() * answer["height"].get<std::size_t>());
    EXPECT_EQ(answer["height"], 80);  // A4 in 100 x 80
    for (const double side : {0.0, -5.0, 1e5, 1e300}) {
        Json large = picture;
        large["width"] = side;
        EXPECT_EQ(kind_of_failure(large), "request") << side;
    }
    Json window = picture;
    window["window"] = {"0", "0", "20", "16"};
    EXPECT_EQ(asked(window)["width"], 100);
    window["window"] = {"0", "0", "nan", "16"};
    EXPECT_EQ(kind_of_failure(window), "setting");
}

TEST(Bridge, CommandsAreQuotedForTheShell) {
    const Json answer =
        asked({{"do", "command"},
               {"interpreter", "draw"},
               {"format", "svg"},
               {"options", pairs({{"stroke", "0.3mm navy"}, {"dots", ""}, {"landscape", "true"}})},
               {"pattern", {{"name", "it's.lsys"}, {"text", koch}, {"settings", pairs({{"seed", "7"}})}}}});
    EXPECT_EQ(answer["command"],
              "sikku draw 'it'\\''s.lsys' --seed 7 --stroke '0.3mm navy' --dots --landscape -o 'it'\\''s.svg'");
}

TEST(Bridge, CommandsHoldNothingButTheirOptions) {
    const auto command = [](const char* interpreter, const Json& options, const char* name) {
        const Json answer = asked({{"do", "command"},
                                   {"interpreter", interpreter},
                                   {"format", interpreter == std::string("draw") ? "svg" : "mid"},
                                   {"options", options},
                                   {"pattern", {{"name", name}, {"text", koch}}}});
        return answer.contains("command") ? answer["command"].get<std::string>() : answer.dump();
    };
    EXPECT_EQ(command("draw", pairs({{"size A4; touch x #", "x"}}), "a.lsys"),
              "sikku draw a.lsys --set 'size A4; touch x #=x' -o a.svg");
    EXPECT_EQ(command("draw", pairs({{"stroke", "false"}}), "-x.lsys"),
              "sikku draw ./-x.lsys --stroke false -o ./-x.svg");
    EXPECT_EQ(command("play", pairs({{"tempo", "96"}}), "a.lsys"), "sikku play a.lsys --tempo 96 -o a.mid");
    EXPECT_EQ(kind_of_failure({{"do", "command"},
                               {"interpreter", "draw"},
                               {"format", "svg; ls"},
                               {"pattern", {{"name", "a.lsys"}, {"text", koch}}}}),
              "setting");
}

TEST(Bridge, CommandsNameTheSourceOfThePattern) {
    const auto command = [](const char* source) {
        return asked({{"do", "command"},
                      {"interpreter", "draw"},
                      {"format", "svg"},
                      {"pattern", pattern("axiom: F\n")},
                      {"source", source}})["command"];
    };
    EXPECT_EQ(command("#sikku1.abc"), "sikku draw '#sikku1.abc' -o test.svg");
    EXPECT_EQ(command("koch-curve"), "sikku draw koch-curve -o test.svg");
}

TEST(Bridge, FindsTheLargestDerivationLengthThatIsDrawn) {
    const auto largest = [](const std::string& text) {
        return asked({{"do", "affordable"}, {"seconds", 600}, {"pattern", pattern(text)}})["n"].get<std::string>();
    };
    // 3 x 10^7 nodes: 6^9 segments, and as many nodes above them as a fifth of that.
    EXPECT_EQ(largest("axiom: F\nderivation length: 25\nF --> FFF+F[F]F\n"), "9");
    // Only deriving counts the words of parameters: 2^(n + 1) - 1 symbols of A, and as many of F but one.
    const std::string parametric = "axiom: A(1)\nA(x) : x>0 --> F(x)A(x+1)A(x+2)\nderivation length: ";
    const int found = std::stoi(largest(parametric + "40\n"));
    EXPECT_GE(found, 22);
    EXPECT_LE(found, 24);
    // A short length whose derivation does not end in time.
    EXPECT_EQ(largest(parametric + "5\n"), "4");
    EXPECT_EQ(largest("axiom: F\nderivation length: 0\n"), "");
}

TEST(Bridge, ReportsMaps) {
    const std::string checkers = "map: clockwise\nderivation length: 2\naxiom: A~B~AB\nA --> B[-A][+~A]B\nB --> ~A\n";
    const Json answer = asked({{"do", "open"}, {"pattern", pattern(checkers)}});
    EXPECT_TRUE(answer["is_map"].get<bool>());
    // Each of the two steps divides every cell.
    EXPECT_EQ(answer["cost"]["cells"], "4");
    EXPECT_EQ(answer["cost"]["symbols"], "");
    const Json large = pattern(checkers, pairs({{"derivation length", "60"}}));
    EXPECT_EQ(asked({{"do", "open"}, {"pattern", large}})["cost"]["cells"], "");
    // The maps of all steps together have 3 x 10^6 edges: each has about twice as many as the one before.
    const Json affordable = asked({{"do", "affordable"}, {"seconds", 600}, {"pattern", large}});
    const int n = std::stoi(affordable["n"].get<std::string>());
    EXPECT_GE(n, 18);
    EXPECT_LE(n, 21);
    EXPECT_FALSE(asked({{"do", "open"}, {"pattern", pattern(koch)}})["is_map"].get<bool>());
}

TEST(Bridge, ListsOptionsThatDoNotApply) {
    const auto unfit = [](const std::string& text, const char* format, const Json& options = Json::array()) {
        const Json question = {{"do", "unfit"}, {"format", format}, {"options", options}, {"pattern", pattern(text)}};
        return asked(question)["options"].get<std::set<std::string>>();
    };
    const std::set<std::string> lines = unfit(koch, "svg");
    for (const char* name : {"swatch", "fill-page", "light", "view", "gcode-start", "compression", "overlap"})
        EXPECT_EQ(lines.count(name), 1U) << name;
    for (const char* name : {"size", "dots", "border", "plotter", "bleed", "generations"})
        EXPECT_EQ(lines.count(name), 0U) << name;
    // What another option needs or excludes follows it.
    EXPECT_EQ(unfit(koch, "svg", pairs({{"tile", "A4"}})).count("overlap"), 0U);
    EXPECT_EQ(unfit(koch, "svg", pairs({{"plotter", "true"}})).count("tile"), 1U);
    EXPECT_EQ(lines.count("pen-width"), 1U);
    EXPECT_EQ(unfit(koch, "svg", pairs({{"plotter", "true"}})).count("pen-width"), 0U);
    // An option that is what a rule asks for is offered.
    EXPECT_EQ(unfit(koch, "obj").count("relief"), 0U);
    EXPECT_EQ(unfit(koch, "obj").count("base"), 1U);
    EXPECT_EQ(unfit(koch, "obj", pairs({{"relief", ""}})).count("base"), 0U);
    EXPECT_EQ(unfit("axiom: {F+F+F+F}\n", "svg").count("swatch"), 0U);
    EXPECT_EQ(unfit("axiom: F&F\n", "png").count("light"), 0U);
    EXPECT_EQ(unfit("axiom: F&F\n", "svg").count("border"), 1U);
    EXPECT_EQ(unfit(koch, "stl").count("base"), 0U);
    EXPECT_EQ(kind_of_failure({{"do", "unfit"}, {"format", "xyz"}, {"pattern", pattern(koch)}}), "request");
}

TEST(Bridge, TracesTheControlPolygonOfASpline) {
    const Json question = {{"do", "lines"}, {"pattern", pattern("axiom: F+f+F[-F]\nline: spline\n")}};
    const Reply reply = request(question.dump(), {});
    EXPECT_EQ(Json::parse(reply.json)["begins"], (Json{0, 4, 6}));
    ASSERT_EQ(reply.bytes.size(), 6 * 2 * sizeof(double));
    std::array<double, 12> places{};
    std::memcpy(places.data(), reply.bytes.data(), sizeof places);
    const std::array<double, 12> expected = {0, 0, 0, 1, 1, 1, 1, 0, 1, 0, 2, 0};
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(places[i], expected[i], 1e-12) << i;
}

TEST(Bridge, OriginsStopInTime) {
    std::string word;
    for (int i = 0; i < 10'000; ++i) word += 'Y';
    Json symbols = Json::array();
    for (int i = 0; i < 200; ++i) symbols.push_back("99890000");
    const Json question = {{"do", "origins"},
                           {"seconds", 0.2},
                           {"symbols", symbols},
                           {"pattern", pattern("axiom: X\nderivation length: 9990\nX --> " + word + "X\n")}};
    EXPECT_EQ(kind_of_failure(question), "stopped");
    Json damaged = question;
    damaged["symbols"] = 5;
    EXPECT_EQ(kind_of_failure(damaged), "request");
    damaged["symbols"] = Json::array({"x"});
    EXPECT_EQ(kind_of_failure(damaged), "request");
}

TEST(Bridge, BracketsThatDoNotBalanceAreErrorsOfTheirProduction) {
    const Json open =
        asked({{"do", "open"}, {"pattern", pattern("axiom: X\nderivation length: 2\nX --> F[+X]]F\n")}});
    ASSERT_EQ(open["warnings"].size(), 1U) << open;
    EXPECT_EQ(open["warnings"][0]["line"], 3);
    EXPECT_EQ(open["warnings"][0]["warning"], false);
}

TEST(Bridge, ScaleFilesAreKept) {
    const std::string scale = "! test.scl\n!\nThree equal steps\n 3\n!\n 400.\n 800.\n 2/1\n";
    EXPECT_EQ(kind_of_failure({{"do", "scale"}, {"name", "x.txt"}}, scale), "request");
    EXPECT_EQ(kind_of_failure({{"do", "scale"}, {"name", "../x.scl"}}, scale), "request");
    EXPECT_EQ(kind_of_failure({{"do", "scale"}, {"name", "x.scl"}}, "no scale"), "pattern");
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(testing::TempDir());
    EXPECT_EQ(kind_of_failure({{"do", "scale"}, {"name", "kept.scl"}}, scale), "");
    const Json notes = {{"do", "notes"}, {"pattern", pattern(koch)}, {"options", pairs({{"scale", "kept.scl"}})}};
    EXPECT_EQ(kind_of_failure(notes), "");
    std::filesystem::remove("kept.scl");
    std::filesystem::current_path(before);
}

TEST(Bridge, DescribesGridsOfDots) {
    const Json square = asked({{"do", "dots"}, {"grid", "3 to 1 ner pulli"}});
    EXPECT_EQ(square["grid"], "1-3-1");
    EXPECT_EQ(square["lattice"], "square");
    EXPECT_EQ(square["is_solid"], true);
    EXPECT_EQ(square["dots"], Json::parse("[[0,2],[-2,0],[0,0],[2,0],[0,-2]]"));
    EXPECT_EQ(square["gaps"], Json::parse("[[0,2,3],[1,2,0],[2,3,0],[2,4,3]]"));
    EXPECT_EQ(square["symmetries"].front()["name"], "D4");
    EXPECT_EQ(square["symmetries"].front()["orbits"], Json::parse("[0,0,0,0]"));
    EXPECT_EQ(square["symmetries"].back()["orbits"], Json::parse("[0,1,2,3]"));
    const Json hexagon = asked({{"do", "dots"}, {"grid", "15-8 idukku pulli"}});
    EXPECT_EQ(hexagon["lattice"], "triangular");
    EXPECT_EQ(hexagon["dots"].size(), 169U);
    EXPECT_EQ(hexagon["symmetries"].front()["name"], "D6");
    EXPECT_TRUE(hexagon["symmetries"].front().contains("obstacle"));
    EXPECT_EQ(kind_of_failure({{"do", "dots"}, {"grid", "15-8 pulls"}}), "other");
    EXPECT_EQ(kind_of_failure({{"do", "dots"}, {"grid", "40x40"}}), "request");
    EXPECT_EQ(kind_of_failure({{"do", "dots"}}), "request");
}

TEST(Bridge, EditsDotsWithTheirImages) {
    const auto edited = [](const char* change, const Json& places, const char* symmetry) {
        return asked({{"do", "dots"}, {"grid", "5-3 idukku"}, {change, places}, {"symmetry", symmetry}});
    };
    EXPECT_EQ(edited("remove", {{0, 0}}, "none")["dots"].size(), 18U);
    EXPECT_EQ(edited("remove", {{4, 0}}, "C6")["dots"].size(), 13U);
    const Json wide = edited("add", {{6, 0}}, "none");
    EXPECT_EQ(wide["dots"].size(), 20U);
    EXPECT_EQ(wide["moved"], Json::parse("[-1,0]"));
    EXPECT_EQ(edited("add", {{6, 0}}, "mirror-x")["moved"], Json::parse("[0,0]"));
    EXPECT_EQ(asked({{"do", "dots"}, {"grid", wide["grid"]}})["dots"], wide["dots"]);
    EXPECT_TRUE(edited("add", {{5, 0}}, "none").contains("error"));  // between two places
    EXPECT_TRUE(edited("add", {{0, 1}}, "none").contains("error"));  // between two rows
    EXPECT_TRUE(edited("add", {{2e9, 0}}, "none").contains("error"));
    EXPECT_TRUE(edited("add", {0}, "none").contains("error"));
    EXPECT_TRUE(edited("add", {{0, 0}}, "C4").contains("error"));
}

TEST(Bridge, MakesKolamsOfThreeStates) {
    const Json made = asked({{"do", "grid"}, {"grid", "2x2"}, {"gaps", "1 02 2"}, {"strands", true}});
    EXPECT_EQ(made["gaps"], "1 02 2");
    EXPECT_EQ(made["lines"], made["strands"].size());
    const std::string text = made["text"];
    EXPECT_TRUE(has(text, "title: Kolam on 2x2 dots\n"));
    EXPECT_TRUE(has(text, "4 dots, 1 of 4 gaps crossed and 2 joined"));
    EXPECT_TRUE(has(text, "// grid: 2x2\n// gaps: 1 02 2\n"));
    const Json random = asked({{"do", "grid"}, {"grid", "7-4"}, {"joined", 1.0}, {"density", 0.0}});
    EXPECT_EQ(random["gaps"].get<std::string>().find_first_of("01"), std::string::npos);
    const Json single = asked({{"do", "grid"}, {"grid", "7-4"}, {"symmetry", "C6"}, {"single_line", true}});
    EXPECT_EQ(single["lines"], 1);
    EXPECT_FALSE(single.contains("obstacle"));
    EXPECT_EQ(kind_of_failure({{"do", "grid"}, {"grid", "2x2"}, {"gaps", "103"}}), "other");
}

TEST(Bridge, ShapesRims) {
    const auto made = [](const char* rim) {
        return asked(
            {{"do", "grid"}, {"grid", "1-3-5-3-1"}, {"gaps", "1111111111111111"}, {"rim", rim}, {"strands", true}});
    };
    EXPECT_EQ(made("round")["shaped"], 0);
    EXPECT_FALSE(has(made("round")["text"].get<std::string>(), "// rim"));
    EXPECT_EQ(made("petal")["shaped"], 4);
    EXPECT_TRUE(has(made("petal")["text"].get<std::string>(), "\n// rim: petal\n"));
    EXPECT_NE(made("petal")["strands"], made("round")["strands"]);
    EXPECT_TRUE(has(made("spiky")["error"]["message"].get<std::string>(), "'spiky': expected round"));
}

TEST(Bridge, ReadsKolamsFromPixels) {
    const Json kolam = asked({{"do", "grid"}, {"grid", "4x5"}, {"composed", true}, {"seed", "3"}});
    const Json drawn = pattern(kolam["text"].get<std::string>() + "dots: 0.25 step #fffaf0\n");
    const Json picture = {{"do", "pixels"},
                          {"width", 500},
                          {"height", 500},
                          {"options", pairs({{"size", "80x80mm"}})},
                          {"pattern", drawn}};
    const std::string pixels = request(picture.dump(), {}).bytes;
    Json question = {{"do", "read"}, {"width", 500}, {"height", 500}, {"source", "a.jpg"}};
    const Reply reply = request(question.dump(), pixels);
    const Json found = Json::parse(reply.json);
    EXPECT_EQ(found["grid"], "4x5");
    EXPECT_EQ(found["gaps"], kolam["gaps"]);
    EXPECT_TRUE(has(found["text"].get<std::string>(), "; read from a.jpg\n"));
    const Json& straight = found["picture"];
    EXPECT_EQ(reply.bytes.size(), 4 * straight["width"].get<std::size_t>() * straight["height"].get<std::size_t>());
    EXPECT_EQ(straight["box"], Json::parse("[-8.0,-7.0,8.0,7.0]"));

    question["fixes"] = {"1,1: join"};
    EXPECT_EQ(asked(question, pixels)["gaps"].get<std::string>()[0], '2');
    question["fixes"] = {"dot"};
    EXPECT_TRUE(asked(question, pixels).contains("error"));
    question.erase("fixes");
    question["part"] = "2";
    EXPECT_TRUE(asked(question, pixels).contains("error"));
    question["height"] = 499;
    EXPECT_EQ(kind_of_failure(question, pixels), "request");
    const Json blank = {{"do", "read"}, {"width", 30}, {"height", 30}, {"source", "x"}};
    EXPECT_EQ(kind_of_failure(blank, std::string(3600, 'x')), "other");
}

TEST(Bridge, FilesWithoutPatternsAreRefused) {
    EXPECT_EQ(kind_of_failure({{"do", "show"}, {"name", "x.png"}}, "no picture"), "other");
    EXPECT_EQ(asked({{"do", "show"}, {"name", "x.svg"}}, "<svg></svg>")["error"]["message"],
              "x.svg: this SVG file contains no pattern");
    EXPECT_EQ(kind_of_failure({{"do", "import"}, {"name", "x.l"}}, "no system"), "other");
    const Json lpfg = asked({{"do", "import"}, {"name", "x.l"}}, "#include <lpfgall.h>\nmodule A();\nAxiom: A();\n");
    EXPECT_TRUE(has(lpfg["error"]["message"].get<std::string>(), "an L+C file of lpfg, which is C++"));
    const Reply svg = request(
        Json({{"do", "make"}, {"interpreter", "draw"}, {"format", "svg"}, {"pattern", pattern(koch)}}).dump(), {});
    EXPECT_EQ(asked({{"do", "show"}, {"name", "x.svg"}}, svg.bytes)["text"], koch);
}

TEST(Bridge, WarnsOfLettersThatDrawNothing) {
    const Json opened =
        asked({{"do", "open"}, {"pattern", pattern("axiom: F\nderivation length: 2\nF --> F+G\nG --> F-G\n")}});
    EXPECT_TRUE(has(opened.dump(), "'G' draws nothing; 'forward: F G' makes it a step"));
    // The error about pasted text shows the line in the pattern language.
    const Json pasted = asked({{"do", "open"}, {"pattern", pattern("axiom: F\nF = F+F\n")}});
    EXPECT_TRUE(has(pasted.dump(), "write 'F --> F+F'"));
}

}  // namespace sikku::bridge_test
