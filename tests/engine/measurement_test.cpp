// tests/engine/measurement_test.cpp: the output of `sikku measure` for words and maps, as JSON and as text.
#include "engine/measurement.h"

#include "engine/derivation/derivation.h"
#include "tests/checks.h"
#include "tests/maps.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sikku::measurement_test {

using Json = nlohmann::ordered_json;

Json measured(const std::string& pattern, const std::string& n = "") {
    Overrides overrides;
    if (!n.empty()) overrides.settings.push_back({"derivation length", n});
    const std::string text = measure_as_json(parse("-", pattern, overrides), 1e6);
    EXPECT_EQ(text.find('\n'), text.size() - 1) << "one line";
    return Json::parse(text);
}

TEST(Measurement, KeepsItsContract) {
    const std::string text = measure_as_json(load("snake-kolam"), 1e6);
    EXPECT_TRUE(
        text.starts_with("{\"title\": \"Snake kolam\", \"n\": 4, \"symbols\": 3239, \"counts\": {\"+\": 683, "
                         "\"-\": 680, \"X\": 512, \"f\": 1364}, \"drawn\": 0, \"moves\": 1364, \"length\": 0.0, "
                         "\"polygons\": 0, \"box\""));
    EXPECT_TRUE(has(text, "\"box\": [0, 0, 31, 31], \"ink\": null, \"end\": [0, 0], \"heading\": "));
    EXPECT_TRUE(text.ends_with("\"closed\": true, \"depth\": 0, \"derived\": false}\n"));
    const Json json = Json::parse(text);
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    EXPECT_EQ(keys,
              (std::vector<std::string>{"title", "n", "symbols", "counts", "drawn", "moves", "length", "polygons",
                                        "box", "ink", "end", "heading", "closed", "depth", "derived"}));
    EXPECT_TRUE(json["heading"].is_number());
    EXPECT_GE(json["heading"], 0);
    EXPECT_LT(json["heading"], 360);
    double sum = 0;
    std::string last;
    for (const auto& [letter, count] : json["counts"].items()) {
        EXPECT_LT(last, letter) << "sorted";
        last = letter;
        sum += count.get<double>();
    }
    EXPECT_EQ(sum, json["symbols"]);
}

TEST(Measurement, BigNumbersAreStrings) {
    const Json big = Json::parse(measure_as_json(load("hilbert", {"", {{"derivation length", "60"}}}), 1e6));
    EXPECT_EQ(big["drawn"], "1329227995784915872903807060280344575");  // 4^60 - 1
    EXPECT_EQ(big["box"].size(), 4U);
    EXPECT_EQ(big["box"][0], "-1152921504606846975");  // 1 - 2^60
    EXPECT_EQ(big["derived"], false);
    // 2^53 - 1 is the last number, 2^53 the first string.
    const std::string doubling = "axiom: A\nA --> AA\n";
    EXPECT_TRUE(measured(doubling, "52")["symbols"].is_number());
    EXPECT_EQ(measured(doubling, "53")["symbols"], "9007199254740992");
    const Json huge = measured(doubling, "40000");
    EXPECT_EQ(huge["symbols"], "about 10^12041");
    // However long the word: A draws nothing.
    EXPECT_EQ(huge["drawn"], 0);
    EXPECT_EQ(huge["moves"], 0);
    EXPECT_EQ(huge["length"].dump(), "0.0");
}

TEST(Measurement, WhatDoublesDoNotHoldIsRefused) {
    EXPECT_TRUE(has(error_of<WordError>([] { measured("axiom: F(1e308)F(1e308)\n"); }), "range of its coordinates"));
}

TEST(Measurement, OfOneSegment) {
    const Json json = measured("title: \"a\\b\taxiom\naxiom: [F(2.5)]\n");
    EXPECT_EQ(json["title"], "\"a\\b\taxiom");
    EXPECT_EQ(json["length"].dump(), "2.5");
    EXPECT_EQ(json["ink"].at(3).dump(), "2.5");
    EXPECT_EQ(json["depth"], 1);
    EXPECT_EQ(json["end"].at(1).dump(), "0");
    EXPECT_EQ(json["counts"]["F"], 1);
    EXPECT_EQ(measured("axiom: AB\nA < B --> F\nderivation length: 1\n")["derived"], true);
    // Symbols and counts are those before the interpretation, the rest those after it.
    const Json interpreted = measured("axiom: X\ninterpret:\nX --> FF\n");
    EXPECT_EQ(interpreted["symbols"], 1);
    EXPECT_EQ(interpreted["counts"].size(), 1U);
    EXPECT_EQ(interpreted["drawn"], 2);
}

TEST(Measurement, SpaceHasThreeAxes) {
    const Json json = measured(
        "angle increment: 22.5\nturn: left\nsymbols: A S L\naxiom: A\nderivation length: 4\n"
        "A --> [&FL!A]/////[&FL!A]///////[&FL!A]\nF --> S/////F\nS --> FL\nL --> [;^^{-f+f+f-|-f+f+f}]\n");
    EXPECT_EQ(json["end"].dump(), "[0,0,0]");
    EXPECT_TRUE(json["heading"].is_null());
    EXPECT_EQ(json["closed"], true);
    EXPECT_EQ(json["depth"], 4);
    EXPECT_EQ(json["box"].size(), 6U);
}

TEST(Measurement, LettersThatDrawNothingAreListed) {
    const std::string dragon = "axiom: F\nangle increment: 90\nderivation length: 10\nF --> F+G\nG --> F-G\n";
    const Json json = measured(dragon);
    EXPECT_EQ(json["undrawn"], Json::array({"G"}));
    EXPECT_EQ(json["drawn"], 512);
    // As Wikipedia's dragon curve is meant.
    const Json meant = measured("forward: F G\n" + dragon);
    EXPECT_EQ(meant["drawn"], 1024);
    EXPECT_FALSE(meant.contains("undrawn"));
    EXPECT_EQ(measured("axiom: +X\nderivation length: 4\nangle increment: 25\nX --> f-[X]+fX\nf --> ff\n")["undrawn"],
              Json::array({"f"}));
}

TEST(Measurement, OfMaps) {
    const Document checkers = parse("-", "title: Checkers\n" + maps::checkers);
    EXPECT_EQ(measure_as_json(checkers.with({{"derivation length", "5"}}), 1e6),
              "{\"title\": \"Checkers\", \"n\": 5, \"cells\": 32, \"edges\": 76, \"vertices\": 45, \"outer\": 24, "
              "\"labels\": {\"A\": 36, \"B\": 40}, \"sides\": {\"4\": 32}}\n");
    EXPECT_EQ(measure_as_text(checkers.with({{"derivation length", "1"}}), 1e6),
              "Checkers, n = 1\ncells    2\nedges    7\nvertices 6\nouter    6\nlabels   A 3   B 4\n"
              "sides    2 with 4\n");
    EXPECT_TRUE(has(error_of<BudgetError>([&] {
                        measure_as_json(checkers.with({{"derivation length", "60"}}), 10'000);
                    }),
                    "the largest derivation length that fits is"));
}

}  // namespace sikku::measurement_test
