#include "engine/geometry/lettering.h"

#include "art/print/page.h"
#include "engine/language/pattern.h"
#include "tests/files.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sikku {
namespace {

/// Everything that was written, flattened to its control points.
class Written : public PathSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        pens.push_back(pen);
        box.add(start);
        ++strokes;
        open = true;
    }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) box.add(end);
        segments += ends.size();
    }
    void curves(std::span<const glm::dvec2> controls) override {
        for (const glm::dvec2 control : controls) box.add(control);
        segments += controls.size() / 3;
    }
    void change_pen(const Pen&) override { FAIL(); }
    void end_stroke(bool) override { open = false; }
    void polygon(std::span<const glm::dvec2>, const Pen&) override { FAIL(); }
    void disc(glm::dvec2, double, const Pen&) override { FAIL(); }

    Box box;
    std::vector<Pen> pens;
    std::size_t strokes = 0, segments = 0;
    bool open = false;
};

Written written(std::string_view text, double height, glm::dvec2 start = glm::dvec2(0.0)) {
    Written sink;
    write_text(text, start, height, Pen{.width = 0.25, .width_set = true, .colour = 1}, sink);
    EXPECT_FALSE(sink.open);
    return sink;
}

TEST(Lettering, CapitalsAreAsHighAsAskedAndStandOnTheLine) {
    for (const double height : {1.0, 2.5, 40.0}) {
        const Written sink = written("HEXLT", height, {7.0, -3.0});
        EXPECT_NEAR(sink.box.low.y, -3.0, 1e-9);
        EXPECT_NEAR(sink.box.high.y, -3.0 + height, 1e-9);
        EXPECT_GE(sink.box.low.x, 7.0);
        EXPECT_LE(sink.box.high.x, 7.0 + text_width("HEXLT", height));
        for (const Pen& pen : sink.pens) EXPECT_EQ(pen, (Pen{.width = 0.25, .width_set = true, .colour = 1}));
    }
}

TEST(Lettering, EveryAsciiCharacterIsWrittenWithinItsRoom) {
    for (char letter = '!'; letter <= '~'; ++letter) {
        const std::string text(1, letter);
        EXPECT_TRUE(has_letters(text)) << text;
        const Written sink = written(text, 1.0);
        EXPECT_GT(sink.strokes, 0u) << text;
        EXPECT_GT(sink.segments, 0u) << text;
        EXPECT_GE(sink.box.low.x, -0.2) << text;
        EXPECT_LE(sink.box.high.x, text_width(text, 1.0) + 0.2) << text;
        EXPECT_GE(sink.box.low.y, -letter_descent) << text;
        EXPECT_LE(sink.box.high.y, letter_ascent) << text;
    }
    EXPECT_EQ(written(" ", 1.0).strokes, 0u);
    EXPECT_GT(text_width(" ", 1.0), 0.3);
}

TEST(Lettering, WidthsAddUpAndGrowWithTheHeight) {
    const double width = text_width("Kolam", 3.0);
    EXPECT_NEAR(text_width("Ko", 3.0) + text_width("lam", 3.0), width, 1e-9);
    EXPECT_NEAR(text_width("Kolam", 6.0), 2 * width, 1e-9);
    EXPECT_EQ(text_width("", 3.0), 0.0);
    EXPECT_LT(text_width("i", 1.0), text_width("M", 1.0));
}

TEST(Lettering, AccentsAreComposed) {
    for (const std::string_view text : {"äöüÄÖÜß", "áéíóúñÁÉÑ", "Sierpiński", "àâçèêëîïôùû", "ṭṇḷṣśṅñṟṛḥṃṁ", "āīūēō",
                                        "čřšžěů", "łŁøØåÅ", "őű", "șțăâî", "ğışİ"}) {
        EXPECT_TRUE(has_letters(text)) << text;
    }
    // An accent takes no room, and stands above the letter; the dot of the i gives way to it.
    EXPECT_EQ(text_width("é", 1.0), text_width("e", 1.0));
    EXPECT_EQ(text_width("e\u0301", 1.0), text_width("e", 1.0));
    EXPECT_GT(written("é", 1.0).box.high.y, written("e", 1.0).box.high.y + 0.1);
    EXPECT_LT(written("ṇ", 1.0).box.low.y, written("n", 1.0).box.low.y - 0.1);
    EXPECT_EQ(written("í", 1.0).strokes, written("i", 1.0).strokes);
    const Written composed = written("ń", 1.0), combined = written("n\u0301", 1.0);
    EXPECT_EQ(composed.box.high, combined.box.high);
    EXPECT_EQ(composed.segments, combined.segments);
}

TEST(Lettering, WhatTheFontDoesNotHaveIsABox) {
    for (const std::string_view text : {"கோ", "日", "\x80", "\xff", "\x01"}) {
        EXPECT_FALSE(has_letters(text));
        EXPECT_GT(written(text, 1.0).strokes, 0u);
    }
    EXPECT_EQ(text_width("日本", 1.0), 2 * text_width("日", 1.0));
    EXPECT_TRUE(has_letters("F → F−F · 60° × 2 – “x” … ’"));
}

TEST(Lettering, TheTextsOfAllPatternsCanBeWritten) {
    for (const auto& file : pattern_files("patterns")) {
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern(file.string(), contents(file), diagnostics);
        for (const char* key : {"title", "source", "description"}) {
            EXPECT_TRUE(has_letters(pattern.text(key))) << file << ": " << pattern.text(key);
        }
    }
}

TEST(Lettering, LongTextsAreShortened) {
    const std::string text = "Quadratic Koch island";
    const double width = text_width(text, 2.0);
    EXPECT_EQ(shortened(text, 2.0, width), text);
    for (const double part : {0.99, 0.5, 0.2}) {
        const std::string less = shortened(text, 2.0, part * width);
        EXPECT_TRUE(less.ends_with("…")) << less;
        EXPECT_LE(text_width(less, 2.0), part * width);
        EXPECT_EQ(less.find(" …"), std::string::npos);
    }
    EXPECT_EQ(shortened(text, 2.0, 0.1), "");
    // Never within a character, nor between a letter and its mark.
    const std::string accented = "e\u0301e\u0301e\u0301e\u0301e\u0301e\u0301";
    const double two = 2.2 * text_width("e", 1.0) + text_width("…", 1.0);
    EXPECT_EQ(shortened(accented, 1.0, two), "e\u0301e\u0301…");
}

TEST(Lettering, LinesBreakAtSpacesAndElseWithinWords) {
    const double width = text_width("mmmmmmmmmm", 1.0);
    EXPECT_EQ(wrapped("one", 1.0, width, 3), std::vector<std::string>{"one"});
    EXPECT_EQ(wrapped("", 1.0, width, 3), std::vector<std::string>{""});
    std::string all;
    for (const std::string& line : wrapped("a few words  that are longer than one line", 1.0, width, 9)) {
        EXPECT_LE(text_width(line, 1.0), width);
        EXPECT_FALSE(line.starts_with(' ') || line.ends_with(' '));
        if (!all.empty()) all += ' ';
        all += line;
    }
    EXPECT_EQ(all, "a few words  that are longer than one line");
    // One long word.
    const std::string word(100, 'F');
    const auto lines = wrapped(word, 1.0, width, 50);
    EXPECT_GT(lines.size(), 3u);
    all.clear();
    for (const std::string& line : lines) all += line;
    EXPECT_EQ(all, word);
    const auto two = wrapped(word, 1.0, width, 2);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_TRUE(two.back().ends_with("…"));
    EXPECT_LE(text_width(two.back(), 1.0), width);
    // No room at all is no endless loop.
    EXPECT_EQ(wrapped(word, 1.0, 0.01, 5), std::vector<std::string>{""});
}

}  // namespace
}  // namespace sikku
