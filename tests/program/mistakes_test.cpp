// tests/program/mistakes_test.cpp: what a new user gets wrong, and what the program says of it.
#include "tests/program.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sikku::mistakes_test {

struct Mistake {
    std::vector<std::string> words;
    std::string said;
};

class Mistakes : public ::testing::Test {
protected:
    Mistakes() {
        folder_.write("mine.lsys", "axiom: F+F+F+F\nF --> F+F-F\nderivation length: 2\nangle factor: 4\n");
        folder_.write("sound.wav", std::string("RIFF\0\0\0\0WAVEfmt ", 16));
        folder_.write("tiles.json", "[]");
        folder_.write("notes.jsonl", "{\"pattern\": \"hilbert\"}\n");
        folder_.write("bare.toml", "size = A4\n");
        folder_.write("loose.lsys", "axiom: F]\n");
        folder_.write("weight.lsys", "axiom: F\nF : 0.3 --> FF\n");
    }
    Outcome run_here(const std::vector<std::string>& words) const { return run(words, {.folder = folder_.path()}); }
    void expect_refused(const Mistake& mistake, int status = 2) const {
        const Outcome outcome = run_here(mistake.words);
        EXPECT_EQ(outcome.status, status) << mistake.said << '\n' << outcome.errors;
        EXPECT_TRUE(has(outcome.errors + outcome.output, mistake.said)) << mistake.said << '\n' << outcome.errors;
    }

    ScratchFolder folder_;
};

TEST_F(Mistakes, WordsOfTheCommandLine) {
    const std::vector<Mistake> mistakes = {
        {{"version"}, "did you mean '--version'?"},
        {{"draw", "mine.lsys"}, "--output FILE is missing; `sikku draw --help` shows how"},
        {{"draw", "-o", "m.svg"}, "PATTERN is missing; `sikku draw --help` shows how"},
        {{"draw", "--dots", "mine.lsys", "-o", "m.svg"},
         "PATTERN is missing: 'mine.lsys' was read as the value of --dots; put PATTERN first, or write --dots=…"},
        {{"draw", "mine.lsys", "--dots", "2mm", "white", "-o", "m.svg"},
         "unexpected argument 'white'; quote a value with blanks: --dots='2mm white'"},
        {{"draw", "mine.lsys", "--border", "-o", "m.svg"}, "--border needs a value: NAME"},
        {{"draw", "mine.lsys", "-o"}, "-o needs a value: FILE"},
        {{"draw", "mine.lsys", "--dots", "-x", "-o", "m.svg"}, "unknown option '-x'"},
        {{"draw", "mine.lsys", "--relief", "-1mm", "-o", "m.stl"},
         "unknown option '-1mm'; a value that begins with '-' is written --relief=-1mm"},
        {{"draw", "mine.lsys", "--border", "-q", "-o", "m.svg"}, "--border needs a value: NAME"},
        {{"draw", "mine.lsys", "--size", "A4", "--size", "A3", "-o", "m.svg"}, "--size is given twice"},
        {{"kolam", "--grid", "3x3", "--density", "50%"}, "--density: expected a number from 0 to 1, not '50%'"},
        {{"kolam", "mine.lsys", "--single-line"}, "--single-line needs --grid"},
        {{"kolam", "--grid", "3x3", "--symmetry", "C2", "--crossings", "all"}, "cannot be combined with --"},
        {{"draw", "mine.lsys", "--stroke", "wide", "-o", "m.svg"}, "sikku: --stroke wide: "},
        {{"draw", "mine.lsys", "--fields", "mood", "-o", "m.svg"}, "sikku: --fields mood: "},
        {{"play", "mine.lsys", "--scale", "dorain", "-o", "m.mid"}, "sikku: --scale dorain: "},
        {{"completion", "csh"}, "SHELL: expected bash, zsh or fish, not 'csh'"},
        {{"gallery", "-j", "5000", "mine.lsys"}, "--jobs: expected a whole number from 0 to 1024, not '5000'"}};
    for (const Mistake& mistake : mistakes) expect_refused(mistake);
}

TEST_F(Mistakes, HelpIsFoundInMoreThanOneWay) {
    const Outcome help = run_here({"--help"});
    const Outcome nothing = run_here({});
    EXPECT_EQ(nothing.status, 2);
    EXPECT_EQ(nothing.output, help.output);
    EXPECT_EQ(run_here({"help"}).output, help.output);
    EXPECT_EQ(run_here({"help"}).status, 0);
    EXPECT_EQ(run_here({"help", "draw"}).output, run_here({"draw", "--help"}).output);
    EXPECT_TRUE(has(help.output, "manual"));
}

TEST_F(Mistakes, ValuesOfOptions) {
    const std::vector<Mistake> mistakes = {
        {{"draw", "borchert-honda", "--variant", "zz", "-o", "m.svg"},
         "--variant zz: unknown variant; the pattern has "},
        {{"play", "hilbert", "--scale", "dorain"}, "--scale dorain: unknown scale 'dorain'; did you mean 'dorian'"},
        {{"play", "hilbert", "--seed", "x"}, "--seed x: expected"},
        {{"draw", "bush-3d", "--view", "90", "-o", "m.svg"}, "--view 90: expected AZIMUTH,ELEVATION"},
        {{"draw", "bush-3d", "--set", "line=spline", "-o", "m.svg"},
         "--set:1:6: drawings in space have straight lines"},
        {{"draw", "hilbert", "--set", "foo=3", "-o", "m.svg"}, "sikku: --set:1:1: unknown key 'foo'"},
        {{"draw", "hilbert", "--border", "kavi", "-o", "m.svg"}, "unknown border; did you mean 'kaavi'?"},
        {{"draw", "hilbert", "--palette", "rainbow", "-o", "m.svg"}, "or the name of a set of powders"},
        {{"play", "hilbert", "--scale", "C major"},
         "unknown scale 'C major'; set the tonic separately: `scale: major`, `tonic: C`"},
        {{"draw", "hilbert", "-o", "m.gif"}, "--generations: required for a .gif"},
        {{"draw", "mine.lsys", "--stroke", "0.3mm rd", "-o", "m.svg"}, "--stroke 0.3mm rd: 'rd' is not a colour"},
        {{"play", "hilbert", "--instrument", "flutee"}, "unknown instrument 'flutee'; did you mean 'flute'?"},
        {{"play", "hilbert", "--instrument", "gizmo"}, "unknown instrument 'gizmo'; expected a General MIDI name"},
        {{"play", "hilbert", "--unit", "x"}, "expected a note value such as 1/16, 1/8 or 3/16, up to 16 whole notes"},
        {{"play", "hilbert", "--mapping", "x"}, "--mapping x: expected runs, counterpoint or symbols"},
        {{"draw", "mine.lsys", "--bleed", "300mm", "-o", "m.pdf"}, "--bleed: expected 0 to 100mm"},
        {{"draw", "mine.lsys", "--bleed", "3mm", "-o", "m.gcode"}, "--bleed: a plot has no bleed"},
        {{"draw", "mine.lsys", "--marks", "-o", "m.svg"}, "--marks: only a PDF"},
        {{"draw", "mine.lsys", "--bits", "1", "-o", "m.png"}, "--bits: only TIFF"},
        {{"draw", "mine.lsys", "--overlap", "5mm", "-o", "m.pdf"}, "--overlap: needs --tile"},
        {{"kolam", "--grid", "3x"}, "--grid: '3x': expected ROWSxCOLUMNS"}};
    for (const Mistake& mistake : mistakes) expect_refused(mistake);
}

TEST_F(Mistakes, LikelyMistakesAreWarnings) {
    folder_.write("bare.lsys", "axiom: F\nF --> F+F\n");
    const std::string axiom = "the productions are not applied, because `derivation length:` is missing";
    const std::string widths = "mm wide are drawn in one pass; set --pen-width to draw them in several";
    const auto said = [&](std::vector<std::string> words) {
        const Outcome outcome = run_here(std::move(words));
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        return outcome.errors;
    };
    EXPECT_TRUE(has(said({"draw", "bare.lsys", "-o", "m.svg"}), axiom));
    EXPECT_TRUE(has(said({"play", "bare.lsys", "--vertical", "voice", "-o", "m.mid"}), axiom));
    EXPECT_FALSE(has(said({"draw", "bare.lsys", "-n", "0", "-o", "m.svg"}), axiom));
    EXPECT_FALSE(has(said({"draw", "mine.lsys", "-o", "m.svg"}), axiom));
    // A warning does not help where nothing is made.
    folder_.write("empty.lsys", "axiom: X\nX --> F+X\n");
    expect_refused({{"draw", "empty.lsys", "-o", "m.svg"}, axiom}, 1);
    expect_refused({{"play", "empty.lsys", "-o", "m.mid"}, axiom});
    EXPECT_TRUE(has(said({"draw", "mine.lsys", "--tile", "A3", "-o", "m.pdf"}), "the print fits on one sheet"));
    const std::vector<std::string> plot = {"draw", "snake-kolam", "--border", "lotus", "--plotter", "-o", "m.svg"};
    EXPECT_TRUE(has(said(plot), widths));
    EXPECT_FALSE(has(said({"draw", "mine.lsys", "--plotter", "-o", "m.svg"}), widths));
    EXPECT_FALSE(
        has(said({"draw", "snake-kolam", "--border", "lotus", "--pen-width", "0.4mm", "-o", "m.gcode"}), widths));
}

TEST_F(Mistakes, WrongNamesAreReportedBeforeAMissingOutput) {
    const std::vector<Mistake> mistakes = {
        {{"draw", "mine.lsys"}, "--output FILE is missing"},
        {{"draw", "hilbrt"}, "no file or pattern named 'hilbrt'; did you mean 'hilbert'?"},
        {{"draw", "mine.lsys", "--colur", "red"}, "unknown option '--colur'"},
        {{"sheet", "mine.lsys", "--colur", "red"}, "unknown option '--colur'"},
        {{"draw", "--colur", "red"}, "unknown option '--colur'"},
        {{"sheet", "mine.lsys", "hilbrt"}, "no file or pattern named 'hilbrt'"},
        {{"sheet", "hilbrt@n=3"}, "no file or pattern named 'hilbrt'"},
        {{"sheet", "mine.lsys@n=3"}, "--output FILE is missing"},
        {{"sheet", "hilbert@2"}, "--output FILE is missing"},
        {{"draw", "my@file.lsys"}, "--output FILE is missing"},
        {{"--colur"}, "unknown option '--colur'; `sikku --help` lists the options"},
        {{"draw"}, "PATTERN is missing"},
        {{"draw", "mine.lsys", "--animate", "-o", "m.gif"},
         "--animate: only an SVG can draw itself; use --generations for a GIF"}};
    for (const Mistake& mistake : mistakes) expect_refused(mistake);
}

TEST_F(Mistakes, UnitsOfTheHelpAreAccepted) {
    EXPECT_EQ(run_here({"draw", "mine.lsys", "--pen-speed", "60mm/s", "--lift-time", "1s", "-o", "m.gcode"}).status,
              0);
    EXPECT_EQ(run_here({"draw", "mine.lsys", "--dpi", "30dpi", "--rotate", "45deg", "-o", "m.png"}).status, 0);
    EXPECT_EQ(run_here({"play", "hilbert", "--seconds", "10s", "-o", "m.mid"}).status, 0);
    EXPECT_EQ(run_here({"gallery", "mine.lsys", "--dpi", "30dpi", "-f", "png", "-o", "g"}).status, 0);
    EXPECT_EQ(run_here({"kolam", "--grid", "3×4"}).status, 0);
}

TEST_F(Mistakes, FilesOfTheWrongKind) {
    ASSERT_EQ(run_here({"draw", "mine.lsys", "-o", "mine.pdf"}).status, 0);
    ASSERT_EQ(run_here({"play", "hilbert", "-o", "mine.mid"}).status, 0);
    ASSERT_EQ(run_here({"play", "hilbert", "-o", "page.html"}).status, 0);
    const std::string pattern = "not a pattern; `sikku show` prints the pattern if Sikku made the file";
    const std::vector<Mistake> mistakes = {
        {{"draw", "mine.pdf", "-o", "m.svg"}, "mine.pdf: this is a PDF file, " + pattern},
        {{"kolam", "mine.pdf"}, "mine.pdf: this is a PDF file, " + pattern},
        {{"measure", "mine.mid"}, "mine.mid: this is a MIDI file, " + pattern},
        {{"check", "page.html"}, "page.html: this is an HTML page, " + pattern},
        {{"draw", "sound.wav", "-o", "m.svg"}, "sound.wav: this is a WAV file, not a pattern\n"},
        {{"draw", "tiles.json", "-o", "m.svg"},
         "tiles.json: this is JSON, not a pattern; `sikku tiling` reads polygons"},
        {{"draw", "mine.lsys", "-o", "x.mid"}, "-o x.mid: this is a score; `sikku play` writes it"},
        {{"draw", "mine.lsys", "-o", "x"}, "-o x: no extension"},
        {{"play", "hilbert", "-o", "x.mp3"}, "-o x.mp3: unknown extension; a score is .mid"},
        {{"play", "hilbert", "-o", "x"}, "-o x: no extension"},
        {{"kolam", "--grid", "3x3", "-o", "x.svg"}, "expected a pattern file, NAME.lsys; `sikku draw` makes"},
        {{"draw", "hilbert.lsys", "-o", "m.svg"}, "hilbert.lsys: No such file or directory; did you mean 'hilbert'?"},
        {{"play", "canonn"}, "no file or pattern named 'canonn'; `sikku play` plays the arrangement 'canon'"},
        {{"draw", "koch", "-o", "m.svg"}, "no file or pattern named 'koch'; did you mean 'koch-curve'"},
        {{"gallery", "kolam"}, "no file or pattern named 'kolam'; did you mean 'kolams'?"},
        {{"gallery", "--file", "foo"}, "no file or bundled gallery file named 'foo'; there are csiro-figure-"},
        {{"gallery", "--file", "bare.toml"}, "bare.toml:1:"},
        {{"gallery", "--file", "bare.toml"}, "text values need quotes"},
        {{"gallery", "mine.lsys", "-f", "gif"}, "`sikku draw` makes them"}};
    for (const Mistake& mistake : mistakes) expect_refused(mistake);
    expect_refused({{"show", "sound.wav"}, "sound.wav: this WAV file contains sound and no pattern"}, 1);
    expect_refused({{"show", "notes.jsonl"}, "notes.jsonl: this text is not a pattern: it has no axiom"}, 1);
    EXPECT_EQ(run_here({"show", "loose.lsys"}).output, "axiom: F]\n");
}

/// No output replaces the file that is read.
TEST_F(Mistakes, FilesThatAreReadStay) {
    const std::string picture = "<svg xmlns=\"http://www.w3.org/2000/svg\"><rect width=\"1\" height=\"1\"/></svg>";
    folder_.write("tiles.svg", picture);
    folder_.write("frac.l", "K {\n Angle 6\n Axiom F--F--F\n F=F+F--F+F\n}\n");
    ASSERT_EQ(run_here({"kolam", "--grid", "3x3", "-o", "k.lsys"}).status, 0);
    ASSERT_EQ(run_here({"draw", "k.lsys", "--dots", "--dpi", "60", "-o", "k.png"}).status, 0);
    const std::string photograph = contents(folder_.file("k.png")), pattern = contents(folder_.file("k.lsys"));
    const std::string why = "this file is read and would be replaced";
    expect_refused({{"kolam", "--read", "k.png", "--overlay", "k.png", "-o", "y.lsys"}, "--overlay k.png: " + why});
    expect_refused({{"kolam", "--read", "k.lsys", "-o", "./k.lsys"}, why});
    expect_refused({{"kolam", "k.lsys", "-o", "k.lsys"}, "-o k.lsys: " + why});
    expect_refused({{"tiling", "tiles.svg", "--templates", "6mm", "-o", "tiles.svg"}, "-o tiles.svg: " + why});
    expect_refused({{"import", "frac.l", "-o", "frac.l"}, why});
    EXPECT_EQ(contents(folder_.file("k.png")), photograph);
    EXPECT_EQ(contents(folder_.file("k.lsys")), pattern);
    EXPECT_EQ(contents(folder_.file("tiles.svg")), picture);
}

TEST_F(Mistakes, WithoutEffectIsReported) {
    const std::vector<Mistake> mistakes = {
        {{"draw", "mine.lsys", "--hatch", "-o", "m.gcode"}, "--hatch has no effect: this drawing has no fills"},
        {{"draw", "mine.lsys", "--compression", "9", "-o", "m.svg"}, "--compression has no effect"},
        {{"draw", "pillaiyar", "--generations", "0:2", "-o", "m.svg"}, "--generations has no effect"},
        {{"play", "hilbert", "--unit", "16", "--bars", "4", "-o", "m.mid"},
         "a step lasts 16 whole notes; did you mean 1/16?"},
        {{"check", "weight.lsys"}, "a weight follows the successor"}};
    ASSERT_EQ(run_here({"kolam", "--grid", "3x3", "-o", "pillaiyar"}).status, 0);
    for (const Mistake& mistake : mistakes) expect_refused(mistake, 0);
}

TEST_F(Mistakes, OfPatterns) {
    const auto said = [&](const std::string& text) {
        folder_.write("bad.lsys", text);
        return run_here({"check", "bad.lsys"}).output;
    };
    EXPECT_TRUE(has(said("axiom: F\nangle: 90\n"), "write 'angle increment: 90'"));
    EXPECT_TRUE(has(said("axiom: F\nn: 3\n"), "write 'derivation length: 3'"));
    EXPECT_TRUE(has(said("axiom: F\ncolour: red\n"), "write 'stroke: red'"));
    EXPECT_TRUE(has(said("# a comment\naxiom: F\n"), "a comment begins with '//'"));
    expect_refused({{"check", "loose.lsys"}, "loose.lsys:1:8: symbol 2 of the word: ']' without '['"});
    // Errors of the file, of its variants, and those that several variants share.
    const std::string all =
        said("axiom: F\nstroke: rd\nvariant a: tempo = x\nvariant b: tempo = y\nvariant c: tempo = 60\n");
    for (const char* place : {"bad.lsys:2:9: ", "bad.lsys:3:", "bad.lsys:4:"}) EXPECT_TRUE(has(all, place));
    EXPECT_EQ(all.find("'rd'"), all.rfind("'rd' is")) << all;
}

TEST_F(Mistakes, NumbersOfManyDigitsAreRounded) {
    expect_refused({{"play", "hilbert", "-n", "1000", "-o", "m.mid"}, "sikku: about 10^601 notes would exceed"}, 1);
    expect_refused({{"draw", "hilbert", "-n", "1000", "-o", "m.svg"}, "sikku: a word of about 10^602 symbols"}, 1);
}

}  // namespace sikku::mistakes_test
