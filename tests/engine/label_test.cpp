// Labels: texts that symbols write where the turtle is.
#include "engine/language/label.h"

#include "engine/geometry/lettering.h"
#include "engine/geometry/polylines.h"
#include "engine/geometry/spline.h"
#include "engine/measure/extent.h"
#include "tests/checks.h"
#include "tests/module_reference.h"

#include <gtest/gtest.h>

namespace sikku::label_test {

using reference::expect_mistakes;

/// The labels that a turtle draws, and its strokes.
struct Written {
    std::string text;
    glm::dvec2 centre;
    double height;
    Pen pen;
};

class LabelRecorder : public reference::Recorder {
public:
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        EXPECT_FALSE(is_open_);
        is_open_ = true;
        Recorder::begin_stroke(start, pen);
    }
    void end_stroke(bool closed) override {
        is_open_ = false;
        Recorder::end_stroke(closed);
    }
    void label(std::string_view text, glm::dvec2 centre, double height, const Pen& pen) override {
        EXPECT_FALSE(is_open_) << "a label within a stroke";
        labels.push_back({std::string(text), centre, height, pen});
    }
    std::vector<Written> labels;

private:
    bool is_open_ = false;
};

LabelRecorder drawn(const std::string& text, bool moves_draw = false) {
    const Grammar grammar = reference::grammar_of(text);
    LabelRecorder recorder;
    const auto turtle = Turtle::drawing(grammar, recorder, moves_draw);
    derive(grammar, *turtle, {.interpreted = true});
    return recorder;
}

TEST(Labels, WriteParametersWhereTheTurtleIs) {
    const LabelRecorder one = drawn("axiom: FN(3)+F;(2)!(4)N(-1.5)\nlabel N: {1}\nlettering: 0.25\n");
    ASSERT_EQ(one.labels.size(), 2u);
    EXPECT_EQ(one.labels[0].text, "3");
    EXPECT_EQ(one.labels[0].centre, glm::dvec2(0, 1));
    EXPECT_EQ(one.labels[0].height, 0.25);
    EXPECT_EQ(one.labels[1].text, "\u22121.5");
    EXPECT_EQ(one.labels[1].centre, glm::dvec2(1, 1));
    EXPECT_EQ(one.labels[1].pen.colour, 2);
    EXPECT_EQ(one.labels[1].pen.width, 4);
    EXPECT_EQ(one.strokes.size(), 1u) << "labels do not break lines";
}

TEST(Labels, ShowTextAndParametersOfModules) {
    const std::string text =
        "axiom: A(1,2)\nderivation length: 2\nA(x,y) --> fB(x/3)A(x+1,y*1000000)\nlabel A: A({1}, {2})\nlabel B: "
        "‹{1}›\n";
    const LabelRecorder words = drawn(text);
    ASSERT_EQ(words.labels.size(), 3u);
    EXPECT_EQ(words.labels[0].text, "‹0.333333›");
    EXPECT_EQ(words.labels[1].text, "‹0.666667›");
    EXPECT_EQ(words.labels[2].text, "A(3, 2000000000000)") << "whole numbers in full";
    EXPECT_EQ(words.labels[2].centre, glm::dvec2(0, 2));
    // The same system with its modules as symbols.
    EXPECT_EQ(drawn("axiom: fB(1)\nlabel B: {1}{1}").labels.at(0).text, "11");
}

TEST(Labels, AreBetweenTheStrokesOfSplines) {
    const std::string text = "axiom: FN(1)fN(2)+FfN(3)[FN(4)]\nlabel N: {1}\n";
    const LabelRecorder straight = drawn(text), spline = drawn(text, true);
    ASSERT_EQ(straight.labels.size(), 4u);
    ASSERT_EQ(spline.labels.size(), 4u);
    EXPECT_EQ(spline.strokes.size(), 2u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(straight.labels[i].text, std::to_string(i + 1));
        EXPECT_EQ(spline.labels[i].text, std::to_string(i + 1));
        EXPECT_EQ(spline.labels[i].centre, straight.labels[i].centre);
    }
    // Letters are not smoothed, and do not count as strokes.
    LabelRecorder smooth;
    StrokeCensus census;
    const Grammar grammar = reference::grammar_of(text);
    derive(grammar, *Turtle::drawing(grammar, census, true));
    EXPECT_EQ(census.closed.size(), 2u);
    SplineSink sink(smooth, census.closed);
    derive(grammar, *Turtle::drawing(grammar, sink, true));
    EXPECT_EQ(smooth.labels.size(), 4u);
    EXPECT_EQ(smooth.strokes.size(), 2u);
}

TEST(Labels, AreStrokesOfLettersForSinksWithoutLabels) {
    const Grammar grammar = reference::grammar_of("axiom: fN(17)\nlabel N: {1}\nlettering: 2\n");
    reference::Recorder recorder, letters;
    derive(grammar, *Turtle::drawing(grammar, recorder, false));
    write_text("17", {-text_width("17", 2) / 2, 0}, 2, {}, letters);
    ASSERT_EQ(recorder.strokes.size(), letters.strokes.size());
    for (std::size_t i = 0; i < letters.strokes.size(); ++i) {
        EXPECT_EQ(recorder.strokes[i].points, letters.strokes[i].points);
    }
}

TEST(Labels, AreInkAndNotSteps) {
    for (const std::string word : {"N(8)", "N(8)A(0)"}) {
        const std::string text =
            "axiom: FF" + word + "\nlabel N: {1}\nlettering: 3\n" + (word.size() > 4 ? "A(x) : x > 0 --> F\n" : "");
        const Measurement measured = measure(reference::grammar_of(text), 1e6);
        EXPECT_EQ(measured.drawn.value, 2);
        EXPECT_EQ(measured.moves.value, 2);
        ASSERT_TRUE(measured.geometry && measured.geometry->ink);
        const auto& ink = *measured.geometry->ink;
        const double half = text_width("8", 3) / 2;
        EXPECT_NEAR(ink[0].value, -half, 1e-12);
        EXPECT_NEAR(ink[2].value, half, 1e-12);
        EXPECT_NEAR(ink[3].value, 3.5, 1e-12);
        EXPECT_EQ(measured.geometry->box[3].value, 2);
    }
    // Too long to be walked: all other measurements are still known.
    const Measurement large =
        measure(reference::grammar_of("axiom: N(8)F\nderivation length: 60\nF --> FF\nlabel N: {1}\n"), 1e6);
    EXPECT_EQ(large.drawn.value, 0x1p60);
    ASSERT_TRUE(large.geometry);
    EXPECT_FALSE(large.geometry->ink);
    EXPECT_EQ(trace(reference::grammar_of("axiom: FN(8)\nlabel N: {1}\n"), {}).points.size(), 2u)
        << "polylines are those of lines";
}

TEST(Labels, AreCheckedWithTheirPlaces) {
    const std::string start = "axiom: FN(1)\n";
    expect_mistakes(start + "label N:\n", {{{2, 1}, "expected a text"}});
    expect_mistakes(start + "label N: v {0}\n", {{{2, 12}, "expected the number of a parameter"}});
    expect_mistakes(start + "label N: {x}\n", {{{2, 10}, "expected the number of a parameter"}});
    expect_mistakes(start + "label N: {2}\n", {{{2, 10}, "shows parameter 2, but words contain 'N' with 1"}});
    expect_mistakes(start + "label F: {1}\n", {{{2, 7}, "'F' is already a command of the turtle"}});
    expect_mistakes(start + "label [: {1}\n", {{{2, 7}, "already a command of the turtle"}});
    expect_mistakes(start + "label %: {1}\n", {{{2, 7}, "already a command of the turtle"}});
    expect_mistakes(start + "label NN: {1}\n", {{{2, 7}, "'NN' is not one symbol"}});
    expect_mistakes(start + "label N: " + std::string(201, 'x') + "\n", {{{2, 10}, "at most 200 bytes"}});
    for (const char* height : {"0", "-1", "x", "1mm"}) {
        expect_mistakes(start + "label N: {1}\nlettering: " + height + "\n", {{{3, 12}, "the height of letters"}});
    }
    EXPECT_TRUE(has(error_of<WordError>([&] { drawn("axiom: N(1/0)\nlabel N: {1}\n"); }), "not finite"));
}

}  // namespace sikku::label_test
