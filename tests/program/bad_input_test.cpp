// tests/program/bad_input_test.cpp: the program accepts or refuses any input quickly and in little memory.
#include "tests/files.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <random>

namespace sikku::bad_input_test {

/// Of processor time, on a machine that does other things as well: what would take for ever takes longer.
constexpr double most_seconds = sanitized ? 60 : 20;
constexpr long most_kilobytes = sanitized ? 4'000'000 : 200 * 1024;

std::string repeated(std::string_view text, std::size_t times) {
    std::string result;
    result.reserve(text.size() * times);
    for (std::size_t i = 0; i < times; ++i) result += text;
    return result;
}

/// Feeds `text` again and again, in blocks, so that this process stays small.
void feed_repeated(const Feed& feed, std::string_view text, std::size_t times) {
    const std::size_t in_block = std::min<std::size_t>(times, 65'536 / text.size() + 1);
    const std::string block = repeated(text, in_block);
    for (; times >= in_block; times -= in_block) {
        if (!feed(block)) return;
    }
    feed(repeated(text, times));
}

/// Ended by itself, soon, in little memory, and its message is text that a terminal can show.
void expect_sane(const Outcome& outcome) {
    EXPECT_TRUE(outcome.status >= 0 && outcome.status <= 2)
        << outcome.status << " " << outcome.errors.substr(0, 1000);
    EXPECT_LT(outcome.seconds, most_seconds);
    EXPECT_LT(outcome.peak, most_kilobytes);
    EXPECT_LT(outcome.errors.size(), 30'000U) << "a message is short whatever it is about";
    for (const char byte : outcome.errors) {
        ASSERT_TRUE(byte == '\n' || (static_cast<unsigned char>(byte) >= 0x20 && byte != 0x7F))
            << "a control character in a message: " << outcome.errors.substr(0, 1000);
    }
}

void expect_refused(const Outcome& outcome, int status, std::string_view message) {
    expect_sane(outcome);
    EXPECT_EQ(outcome.status, status);
    EXPECT_TRUE(has(outcome.errors, message));
    EXPECT_EQ(outcome.output, "");
}

Outcome piped(std::string text, std::vector<std::string> arguments = {}, const char* command = "measure") {
    arguments.insert(arguments.begin(), {command, "-"});
    return run(arguments, {.input = std::move(text)});
}

void expect_mistake(std::string text, std::string_view message, std::vector<std::string> arguments = {}) {
    SCOPED_TRACE(text.substr(0, 200));
    expect_refused(piped(std::move(text), std::move(arguments)), 2, message);
}

void expect_answer(std::string text, std::string_view part, std::vector<std::string> arguments = {}) {
    SCOPED_TRACE(text.substr(0, 200));
    arguments.emplace_back("--json");
    const Outcome outcome = piped(std::move(text), std::move(arguments));
    expect_sane(outcome);
    EXPECT_EQ(outcome.status, 0) << outcome.errors.substr(0, 1000);
    EXPECT_TRUE(has(outcome.output, part));
}

Outcome drawn(std::string text, std::vector<std::string> arguments = {}, const char* name = "x.svg") {
    const ScratchFolder folder;
    arguments.insert(arguments.begin(), {"draw", "-", "-o", folder.file(name)});
    const Outcome outcome = run(arguments, {.input = std::move(text)});
    EXPECT_EQ(folder.names().size(), outcome.status == 0 ? 1U : 0U) << "a print appears whole or not at all";
    if (outcome.status == 0) {
        const std::string print = contents(folder.file(name));
        EXPECT_FALSE(has(print, "nan"));
        EXPECT_FALSE(has(print, "inf\""));
        EXPECT_FALSE(has(print, "inf "));
    }
    return outcome;
}

// --- files that are no patterns -----------------------------------------------------------------------------------

TEST(BadInput, Empty) {
    expect_mistake("", "-:1:1: 'axiom:' is missing");
    expect_mistake("\n\n", "'axiom:' is missing");
    expect_mistake("F --> FF\n", "'axiom:' is missing");
    expect_mistake("axiom:\n", "-:1:1: ");
}

TEST(BadInput, Binary) {
    std::mt19937 random(1);
    for (int i = 0; i < 10; ++i) {
        std::string bytes;
        for (int k = 0; k < 3000; ++k) bytes += static_cast<char>(random());
        expect_mistake(bytes, "a pattern file is UTF-8 text");
    }
    expect_mistake(std::string("axiom: F\0F\n", 11), "-:1:9: a NUL byte");
    expect_mistake(std::string(100'000, '\0'), "-:1:1: a NUL byte");
    expect_mistake("axiom: F\xC0\x80", "-:1:9: invalid UTF-8");
    expect_mistake("axiom: F\xED\xA0\x80", "-:1:9: invalid UTF-8");
    expect_mistake("axiom: F\xF5\x80\x80\x80", "-:1:9: invalid UTF-8");
    expect_mistake(std::string("\xFF\xFE"
                               "a\0x\0",
                               6),
                   "-:1:1: invalid UTF-8");
}

TEST(BadInput, MessagesAreUtf8WhateverTheFileIs) {
    for (const std::string bytes :
         {"\xED\xA0\x80", "\xF5\x80\x80\x80", "\xFC\x8C\x8B\x8D", "\xF0\x80\x80\x80", "\xC3"}) {
        const Outcome outcome = piped("axiom: F" + bytes + "F\n");
        EXPECT_EQ(outcome.status, 2);
        EXPECT_FALSE(has(outcome.errors, bytes));
    }
}

TEST(BadInput, OneGigabyteOfOneLine) {
    for (const char* command : {"measure", "derive", "check", "show"}) {
        SCOPED_TRACE(command);
        const Outcome outcome =
            run({command, "-"}, {.feed = [](const Feed& feed) { feed_repeated(feed, "a", std::size_t{1} << 30); }});
        expect_sane(outcome);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_TRUE(has(outcome.errors + outcome.output.substr(0, 1000), "64 MB"));
    }
    const ScratchFolder folder;
    const std::string sparse = folder.write("sparse.lsys", "axiom: F\n");
    std::filesystem::resize_file(sparse, std::uintmax_t{1} << 30);
    expect_refused(run({"measure", sparse}), 2, "64 MB");
    expect_refused(run({"draw", sparse, "-o", folder.file("x.svg")}), 2, "64 MB");
}

TEST(BadInput, ManyLines) {
    const auto lines = [](std::string_view line, std::size_t times) {
        const Outcome outcome =
            run({"measure", "-"}, {.feed = [&](const Feed& feed) { feed_repeated(feed, line, times); }});
        expect_sane(outcome);
        EXPECT_EQ(outcome.status, 2);
    };
    lines("\n", 60'000'000);
    lines(" ", 60'000'000);
    lines("x\n", 1'000'000);
    lines(":\n", 1'000'000);
    lines("k: 1\n", 1'000'000);
    lines("F --> FF\n", 1'000'000);
    lines("x < F > y --> FF\n", 300'000);
    lines("axiom: F \\\n", 1'000'000);
    lines("A < ", 1'000'000);
    lines("-->(", 1'000'000);
}

TEST(BadInput, AFolder) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path() / "x.lsys");
    for (const char* command : {"measure", "derive", "check", "show"}) {
        expect_refused(run({command, folder.file("x.lsys")}), 2, "is a folder");
    }
    expect_refused(run({"draw", folder.file("x.lsys"), "-o", folder.file("x.svg")}), 2, "is a folder");
}

// --- text that is well read ---------------------------------------------------------------------------------------

TEST(BadInput, LineEndsAndMarks) {
    for (const char* text : {"axiom: F+F\r\nF --> FF\r\n",
                             "\xEF\xBB\xBF"
                             "axiom: F+F\nF --> FF",
                             "axiom: F+F \\\r\n\r\nF --> FF\r\n",
                             "\xEF\xBB\xBF"
                             "axiom: F+F\r\nF --> FF"}) {
        const Outcome outcome = piped(text, {"-n", "1"}, "derive");
        EXPECT_EQ(outcome.output, "FF+FF\n") << outcome.errors;
        EXPECT_EQ(outcome.status, 0);
    }
}

TEST(BadInput, SymbolsBeyondAscii) {
    const Outcome outcome = piped("axiom: FåF日本\nå --> F😀\n", {"-n", "1"}, "derive");
    EXPECT_EQ(outcome.output, "FF😀F日本\n") << outcome.errors;
    expect_mistake("axiom: F−F", "-:1:9: '−' is not a symbol: write '-'");
    expect_mistake("axiom: åF→F", "-:1:10: ");
    expect_mistake("axiom: F\nF → FF", "-:2:3: '→' is not the arrow of a production; write 'F --> FF'");
    expect_mistake("axiom: F\nF -> FF", "-:2:3: '->' is not the arrow of a production; write 'F --> FF'");
    expect_mistake("axiom: F\nF => FF", "-:2:3: '=>' is not the arrow of a production; write 'F --> FF'");
    expect_mistake("axiom: A(1)\nA(x) : x => 4 --> F", "'=>' is not an operator; did you mean '>='?");
    expect_mistake("axiom: A(1)\nA(x) : x =< 4 --> F", "'=<' is not an operator; did you mean '<='?");
    expect_mistake("axiom: F\nstroke: 0.3 stp white",
                   "-:2:13: 'stp' is not a unit; expected mm, cm, in, pt, px or step");
    expect_mistake("axiom: F\x1B[31mF", "-:1:9: a control character");
    expect_mistake("axiom: F\n\x1B[31mfoo: 3\n", "-:2:1: ");
    expect_mistake("axiom: F\xC2\x85", "-:1:9: a control character");
}

// --- keys and productions -----------------------------------------------------------------------------------------

TEST(BadInput, KeysAndValues) {
    expect_mistake("axim: F\n", "-:1:1: unknown key 'axim'; did you mean 'axiom'?");
    expect_mistake("axiom: F\naxiom: F\n", "-:2:1: 'axiom:' is given twice");
    for (const char* value : {"0", "-1", "1e3", "abc", "", "9223372036854775808", "nan", "inf"}) {
        expect_mistake("axiom: F\nangle factor: " + std::string(value), "-:2:");
    }
    for (const char* key : {"heading: ", "angle increment: "}) {
        for (const char* value : {"inf", "nan", "1e400", "1/0", "0/0", "360/0", "1e300/1e-300", "x", ""}) {
            expect_mistake("axiom: F\n" + (key + std::string(value)), "-:2:");
        }
        for (const char* value : {"1e308", "-1e308", "1e-320", "-0", "1e300/1e300", "360/7"}) {
            expect_answer("axiom: F+F\n" + (key + std::string(value)), "\"drawn\": 2");
        }
    }
    for (const char* line : {"derivation length: nan",
                             "derivation length: -1",
                             "derivation length: 1.5",
                             "derivation length: 99999999999999999999",
                             "seed: -1",
                             "scale factor: nan",
                             "scale factor: 0",
                             "scale factor: inf",
                             "stroke: nanmm",
                             "stroke: inf mm",
                             "stroke: 1e308mm",
                             "stroke: -1mm",
                             "stroke: 0mm",
                             "stroke: nan step",
                             "palette:",
                             "turn: up",
                             "ignore: a,b",
                             "line: bent",
                             "schedule:",
                             "schedule: nowhere",
                             "table :",
                             "variant v: x",
                             "F",
                             "--> F",
                             "* --> F",
                             "F --> G --> H",
                             "/* open",
                             "define",
                             "define a =",
                             "define 1a = 2"}) {
        expect_mistake("axiom: F\n" + std::string(line), "-:2:");
    }
    expect_mistake("axiom: F\nforward: F\nmove: F", "-:3:7: 'F' is listed under both");
    expect_mistake("axiom: F\ntable a:\ntable b:", "-:3:7: several tables need a 'schedule:'");
    expect_mistake("axiom: X\nderivation length: 5\ntable a:\nX --> F\ntable b:\nX --> f\nschedule: a b\n",
                   "-:7:11: the schedule has 2 steps, but the derivation length is 5");
}

TEST(BadInput, Brackets) {
    // Unbalanced productions are fine if the word balances.
    expect_answer("axiom: XY\nX --> [F\nY --> ]F\nderivation length: 1\n", "\"drawn\": 2");
    for (const char* json : {"--json", "--quiet"}) {
        expect_mistake("axiom: X]\nX --> [F\n", "symbol 2 of the word: ']' without '['", {json});
        expect_mistake("axiom: F+[F", "symbol 3 of the word: this '[' is not closed", {json});
        expect_mistake("axiom: F+{F", "symbol 3 of the word: this '{' is not closed", {json});
        expect_mistake("axiom: F+}F", "symbol 3 of the word: '}' without '{'", {json});
    }
    expect_mistake("axiom: X\nX --> F[X\n", "symbol 4 of the word: this '[' is not closed", {"-n", "2"});
    expect_refused(drawn("axiom: F]F"), 2, "symbol 2 of the word");
    expect_refused(drawn("axiom: F{F"), 2, "symbol 2 of the word");
}

const std::string leaf_patch =
    "patch leaf:\n0 0 0, .3 0 0, .6 0 0, 1 0 0\n-.5 1 .3, 0 1 0, .5 1 0, 1.5 1 .3\n"
    "-.5 2 .3, 0 2 0, .5 2 0, 1.5 2 .3\n0 3 0, .3 3 0, .6 3 0, 1 3 0\n";

TEST(BadInput, InsertedEdges) {
    for (const char* json : {"--json", "--quiet"}) {
        expect_mistake("edges: ? #\naxiom: F?F", "symbol 2 of the word: this inserted edge has no end", {json});
        expect_mistake("edges: ? #\naxiom: F#F?", "symbol 2 of the word: the end of an inserted edge without its",
                       {json});
        expect_mistake("edges: ? #\naxiom: &F#F?", "symbol 3 of the word: the end of an inserted edge", {json});
    }
    expect_refused(drawn("edges: ? #\naxiom: F?F"), 2, "symbol 2 of the word");
    // As many as there can be: nested, one after the other, and around long axes.
    expect_refused(piped("edges: ? #\naxiom: A\nA --> AA\nderivation length: 21\ninterpret:\nA --> ?\n"), 2,
                   "nest deeper than 1,048,576");
    expect_answer("edges: ? #\naxiom: A\nA --> AA\nderivation length: 20\ninterpret:\nA --> [F?]F#\n",
                  "\"polygons\": 1048576");
    expect_refused(drawn("edges: ? #\naxiom: [B?]A\nA --> AA\nB --> BB\nderivation length: 14\ninterpret:\n"
                         "A --> F#?\nB --> F\n"),
                   2, "symbol");
}

TEST(BadInput, Surfaces) {
    // Numbers that are not finite, in patches and where they are used.
    for (const char* wrong : {"nan", "inf", "-inf", "1e400", "1e10", "x"}) {
        expect_mistake("axiom: ~leaf\npatch leaf:\n1 2 " + std::string(wrong) + "\n",
                       "-:3:5: expected a coordinate, a number up to 10^9");
    }
    expect_mistake("axiom: ~leaf\npatch leaf:\nnan 0 0\n", "-:3:1: expected a coordinate");
    expect_mistake("axiom: A(0)\nA(x) --> ~leaf(1/x)\nderivation length: 1\n" + leaf_patch, "finite");
    expect_sane(drawn("axiom: ~leaf(0)F\n" + leaf_patch));
    expect_sane(drawn("axiom: ~leaf(1,-1,1)~leaf(-2)~leaf(1e-300)F\n" + leaf_patch));
    expect_refused(drawn("axiom: ~leaf(1e300)F\n" + leaf_patch), 1, "larger than 10^18 steps");
    // Too many patches: in the pattern, and in the word.
    expect_refused(run({"measure", "-"}, {.feed =
                                              [](const Feed& feed) {
                                                  feed("axiom: F\n");
                                                  feed_repeated(feed, leaf_patch, 400'000);
                                              }}),
                   2, "a pattern has at most 4096");
    const std::string leaves = "axiom: A\nA --> AA\ninterpret:\nA --> ~leaf+(10)\n" + leaf_patch;
    for (const char* format : {"x.svg", "x.png", "x.glb", "x.hpgl"}) {
        SCOPED_TRACE(format);
        expect_refused(drawn(leaves, {"-n", "21"}, format), 1, "the budget allows");
    }
    expect_answer("derivation length: 21\n" + leaves, "\"moves\": 0");
}

TEST(BadInput, SurfaceFiles) {
    const ScratchFolder folder;
    const auto drawn_with = [&](const std::string& file) {
        folder.write("p.lsys", "axiom: ~leaf\nsurface: leaf = " + file + "\n");
        return run({"draw", folder.file("p.lsys"), "-o", folder.file("p.svg")});
    };
    folder.write("secret.txt", "the first line\n");
    std::filesystem::create_directory(folder / "folder.s");
    expect_refused(drawn_with("missing.s"), 2, "p.lsys:2:17: 'missing.s' cannot be read: No such file");
    expect_refused(drawn_with("folder.s"), 2, "'folder.s' cannot be read: this is not a regular file");
    // Other files are not opened, and nothing of them is shown.
    for (const std::string file : {"secret.txt", "/etc/passwd", "../../etc/passwd", "/dev/zero", "."}) {
        const Outcome outcome = drawn_with(file);
        expect_refused(outcome, 2, "expected a surface file, whose name ends in .s");
        EXPECT_FALSE(has(outcome.errors, "the first line"));
        EXPECT_FALSE(has(outcome.errors, "root:"));
    }
    std::filesystem::create_symlink("/dev/zero", folder / "zero.s");
    expect_refused(drawn_with("zero.s"), 2, "this is not a regular file");
    folder.write("binary.s", std::string(1000, '\0') + "\xff\xfe\x1b[31m");
    expect_refused(drawn_with("binary.s"), 2, "binary.s:1:");
    folder.write("large.s", std::string((4 << 20) + 1, ' '));
    expect_refused(drawn_with("large.s"), 2, "at most 4 MB in all");
    // Neighbours in a circle, a patch that is its own, and one that names itself first.
    std::string text = "0 1 0 1 0 1\n", many = text;
    const auto patch = [](const std::string& name, const std::string& around) {
        return name + "\nTOP COLOR: 0 DIFFUSE: 0.5 BOTTOM COLOR: 0 DIFFUSE: 0.5\nAL: " + around + " A: " + around +
               " AR: ~\nL: " + around + " R: " + around + "\nBL: ~ B: " + around + " BR: ~\n" +
               "0 0 0 1 0 1 2 0 1 3 0 0\n0 1 1 1 1 3 2 1 3 3 1 1\n0 2 1 1 2 3 2 2 3 3 2 1\n" +
               "0 3 0 1 3 1 2 3 1 3 3 0\n";
    };
    folder.write("circle.s", text + patch("a", "b") + patch("b", "c") + patch("c", "a") + patch("d", "d"));
    expect_sane(drawn_with("circle.s"));
    EXPECT_TRUE(std::filesystem::exists(folder / "p.svg"));
    for (int i = 0; i < 4096; ++i) many += patch("p" + std::to_string(i), "p" + std::to_string(i * 7 % 4096));
    folder.write("full.s", many);
    expect_refused(drawn_with("full.s, more = circle.s"), 2, "a pattern has at most 4096 patches in all");
    folder.write("more.s", many + patch("more", "~"));
    expect_refused(drawn_with("more.s"), 2, "more.s:36866:1: a surface has at most 4096 patches");
    // From a pipe a name is relative to the working directory.
    expect_refused(piped("axiom: ~leaf\nsurface: leaf = missing.s\n"), 2, "-:2:17: 'missing.s' cannot be read");
}

TEST(BadInput, DeepBrackets) {
    const std::size_t millions = 3'000'000;
    expect_sane(piped("axiom: " + std::string(millions, '[') + std::string(millions, ']')));
    expect_mistake("axiom: " + std::string(millions, '['), "symbol ");
    expect_sane(piped("axiom: " + std::string(millions, '{') + std::string(millions, '}')));
    expect_sane(drawn("axiom: F" + repeated("[+", millions) + "F" + std::string(millions, ']')));
    expect_answer("axiom: X\nX --> [X]F\n", "\"depth\": 1000000", {"-n", "1000000"});
    expect_sane(drawn("axiom: X\nX --> F[X]\n", {"-n", "1000000"}));
    const Outcome deep = run({"measure", "-"}, {.feed = [](const Feed& feed) {
                                 feed("axiom: ");
                                 feed_repeated(feed, "[", 20'000'000);
                             }});
    expect_refused(deep, 2, "symbol ");
}

TEST(BadInput, ManyProductions) {
    std::string text = "axiom: F\nsymbols:";
    for (int i = 0; i < 100'000; ++i) text += " a" + std::to_string(i);
    text += '\n';
    for (int i = 0; i + 1 < 100'000; ++i) {
        text += "a" + std::to_string(i) + " --> a" + std::to_string(i + 1) + " F\n";
    }
    expect_answer(text, "\"drawn\": 1", {"-n", "100"});
    // A million, of which all but 20,000 are mistakes.
    const Outcome million = run({"measure", "-"}, {.feed = [](const Feed& feed) {
                                    feed("axiom: F\n");
                                    std::string block;
                                    for (int i = 0; i < 20'000; ++i) {
                                        const int point = 0x4E00 + i;
                                        block += static_cast<char>(0xE0 | (point >> 12));
                                        block += static_cast<char>(0x80 | ((point >> 6) & 63));
                                        block += static_cast<char>(0x80 | (point & 63));
                                        block += " --> FF\n";
                                    }
                                    for (int i = 0; i < 50; ++i) feed(block);
                                }});
    expect_refused(million, 2, "can never apply");
}

TEST(BadInput, ManyTablesVariantsDefinesKeys) {
    std::string tables = "axiom: X\nderivation length: 3\n";
    std::string schedule = "schedule:";
    std::string variants = "axiom: F\n";
    std::string defines = "axiom: F(a0)\n";
    std::string keys = "axiom: F\n";
    for (int i = 0; i < 30'000; ++i) {
        const std::string number = std::to_string(i);
        tables += "table t" + number + ":\nX --> X\n";
        schedule += " t" + number;
        variants += "variant v" + number + ": heading = 1\n";
        defines += "define a" + number + " = a" + std::to_string(i + 1) + "+1\n";
        keys += "k" + number + ": 1\n";
    }
    expect_answer(tables + schedule, "\"symbols\": 1");
    expect_answer(variants, "\"symbols\": 1");
    expect_answer(defines + "define a30000 = 1\n", "\"length\": 30001.0");
    expect_mistake(defines + "define a30000 = a0\n", "refers to itself");
    expect_mistake(keys, "too many keys");
}

TEST(BadInput, WhatTablesRepeat) {
    std::string names = "symbols:";
    std::string rules;
    std::string tables;
    std::string schedule = "schedule: t0*n\n";
    std::string own;
    for (int i = 0; i < 3000; ++i) {
        const std::string number = std::to_string(i);
        names += " a" + number;
        rules += "a" + number + " --> a" + number + " F\n";
        tables += "table t" + number + ":\nX --> X\n";
        own += "table t" + number + ":\na" + number + " --> F\n";
    }
    const std::string head = "axiom: X\n" + names + "\n" + schedule;
    expect_mistake(head + rules + tables, "the productions before the first table are too many");
    expect_mistake(head + own, "3000 tables of 3002 symbols are too many");
    std::string word = "axiom: ";
    for (int i = 0; i < 600'000; ++i) word += "F(" + std::to_string(i) + ")";
    expect_mistake(word, "more than 524,288 different symbols");
}

TEST(BadInput, ScheduleOfManyItems) {
    const std::string head = "axiom: X\nderivation length: 100000\ntable a:\nX --> XF\ntable b:\nX --> fX\n";
    expect_answer(head + "schedule: " + repeated("a b ", 50'000), "\"drawn\": 50000");
    expect_answer(head + "schedule: " + repeated("a*(n/n) b*1 ", 50'000), "\"drawn\": 50000");
    expect_mistake(head + "schedule: " + repeated("a b ", 49'999), "the schedule has 99998 steps");
    expect_mistake(head + "schedule: a*(0/0) b*(n)", "not a number");
    expect_answer(head + "schedule: a*(-5) b*(1e300)", "\"drawn\": 0");
    const std::string units = "axiom: F\ntable a:\nF --> F\nschedule: a*n\n";
    expect_answer(units, "\"drawn\": 1", {"-n", "9223372036854775807"});
}

TEST(BadInput, CyclicDefines) {
    expect_mistake("define a = b\ndefine b = c\ndefine c = a\naxiom: F(a)\n", "refers to itself");
    expect_mistake("define a = a\naxiom: F(a)\n", "-:1:8: the definition of 'a' refers to itself");
}

TEST(BadInput, DeepExpressions) {
    for (const std::size_t depth : {10'000UL, 1'000'000UL}) {
        const std::string open(depth, '(');
        const std::string close(depth, ')');
        expect_answer("axiom: F(" + open + "2" + close + ")", "\"length\": 2.0");
        expect_mistake("axiom: F(" + open + "2)", "is not closed");
        expect_answer("define a = " + open + "2" + close + "\naxiom: F(a)\n", "\"length\": 2.0");
        expect_answer("define a = " + std::string(depth, '-') + "2\naxiom: F(a)\n", "\"length\": 2.0");
        expect_answer("define a = " + repeated("1^", depth) + "2\naxiom: F(a)\n", "\"length\": 1.0");
        expect_answer("define a = " + repeated("max(1,", depth) + "2" + close + "\naxiom: F(a)\n", "\"length\": 2.0");
    }
    const std::size_t deeper = 2'000'000;
    expect_mistake("axiom: F(" + std::string(deeper, '(') + "1" + std::string(deeper, ')') + ")", "nest deeper than");
}

TEST(BadInput, LongTokens) {
    const std::string token(10'000'000, 'a');
    expect_mistake(token + ": 3\naxiom: F\n", "-:1:1: unknown key");
    expect_mistake(token + "\naxiom: F\n", "-:1:1: ");
    expect_mistake("axiom: F(" + token + ")\n", "is not defined");
    expect_mistake("axiom: F(" + token + "(1))\n", "unknown function");
    expect_mistake("axiom: F\nschedule: " + token, "unknown table");
    expect_mistake("axiom: F\nline: " + token, "-:2:7: ");
    expect_mistake("axiom: F\nstroke: " + token, "-:2:9: ");
    expect_mistake("axiom: F\npalette: " + token, "-:2:10: ");
    expect_mistake("axiom: F\ndefine " + token + "- = 3", "-:2:8: ");
    expect_mistake("axiom: F\nvariant " + token + ": x", "expected 'key = value'");
    expect_mistake("axiom: F(" + std::string(1'000'000, '9') + ")", "-:1:10: ");
    expect_answer("axiom: F(0." + std::string(1'000'000, '9') + ")", "\"length\": 1.0");
    expect_mistake("axiom: F\ndefine " + token + " = x", "is not defined");
    expect_sane(piped("symbols: " + repeated("ab", 30'000) + "c\naxiom: " + repeated("ab", 30'000)));
    expect_refused(run({"measure", std::string(100'000, 'a')}), 2, "");
    expect_refused(run({"measure", "hilbert", "--set", std::string(100'000, 'a') + "=1"}), 2, "--set");
    expect_refused(run({"measure", "hilbert", "--variant", std::string(100'000, 'a')}), 2, "--variant aaaa");
}

TEST(BadInput, ALargeAxiom) {
    const auto axiom = [](std::string_view ending) {
        return run({"measure", "-", "--json"}, {.feed = [&](const Feed& feed) {
                       feed("axiom: ");
                       feed_repeated(feed, "FG", 30'000'000);
                       feed(ending);
                   }});
    };
    // It may be read or refused; a mistake in it is refused as soon as any other.
    const Outcome outcome = axiom("\n");
    EXPECT_TRUE(outcome.status == 0 ? has(outcome.output, "\"drawn\": 30000000")
                                    : ::testing::AssertionResult(outcome.status == 2));
    EXPECT_LT(outcome.seconds, 2 * most_seconds);
    EXPECT_LT(outcome.peak, 4 * most_kilobytes);
    expect_refused(axiom("(\n"), 2, "-:1:60000008: ");
}

// --- numbers in words ---------------------------------------------------------------------------------------------

TEST(BadInput, ParametersOfEverySize) {
    for (const char* word :
         {"F(1/0)", "F(0/0)", "F+(1/0)F", "F(log(-1))", "F;(1/0)F", "F,(0/0)F", "F@O(1/0)F", "F#(1/0)F"}) {
        expect_mistake("axiom: " + std::string(word), "its parameter is not finite");
        expect_refused(drawn("axiom: " + std::string(word)), 2, "its parameter is not finite");
    }
    for (const char* word : {"F(1e308)",
                             "F(1e308)F(1e308)",
                             "F(1e308)+F(1e308)F",
                             "F(1e200)+F(1e200)",
                             "F(-1)",
                             "F(1e-320)+F(1e-320)",
                             "+(1e300)F",
                             "F+(1e-300)F",
                             "F;(1e20)F",
                             "F;(-1e20)F",
                             "@O(-1)F",
                             "F@O(1e308)",
                             "#(1e308)F",
                             "#(-1)F",
                             "#(0)F",
                             "{F(1e308)+F(1e308)+F}",
                             "F(0)",
                             "F(0)+F(0)",
                             "@.",
                             "@O",
                             "@O(0)",
                             "F(9e18)F(9e18)F(9e18)",
                             "F(4611686018427387904)F(4611686018427387904)",
                             "F(1e18)+F(0.3)",
                             "-(1e17)F",
                             "F(1,2,3)",
                             "[[[F]]]",
                             "f"}) {
        for (const char* more :
             {"", "\nline: spline\nangle factor: 7", "\nangle increment: 12.345\nstroke: 0.2 step"}) {
            const std::string text = "axiom: " + (word + std::string(more));
            SCOPED_TRACE(text);
            const Outcome told = piped(text, {"--json"});
            expect_sane(told);
            // Where doubles end, the turtle says so.
            const bool too_far = told.errors.find("range of its coordinates") != std::string::npos;
            EXPECT_EQ(told.status, too_far ? 2 : 0) << told.errors;
            EXPECT_EQ(too_far && text.find("e308") == std::string::npos, false) << told.errors;
            expect_sane(drawn(text));
            expect_sane(drawn(text, {}, "x.pdf"));
            expect_sane(drawn(text, {"--step", "1mm"}));
        }
    }
    expect_sane(drawn("axiom: " + std::string(5000, '#') + "F"));
    expect_sane(drawn("axiom: " + std::string(5000, '!') + "F"));
    expect_sane(drawn("axiom: " + std::string(100'000, ';') + "F"));
    for (const char* word : {"F()", "F(1,)", "F(x)", "F(1", "F)", "F (1)", "@", "@(1)", "a(b", "F(sin)", "F(sin())",
                             "F(max(1))", "F(1 2)", "F(1+)", "F(1e)", "F(0x10)", "F(1e99999)"}) {
        expect_mistake("axiom: " + std::string(word), "-:1:");
    }
}

TEST(BadInput, NumbersThatAreNot) {
    expect_answer("axiom: GF\nX --> F(1/0)\n", "\"length\": 1.0");
    expect_mistake("axiom: F+(1/0)F\n", "symbol 2 of the word: its parameter is not finite");
    expect_mistake("axiom: F-(0/0)F\n", "symbol 2 of the word: its parameter is not finite");
    expect_mistake("axiom: F(1/0)\n", "symbol 1 of the word: its parameter is not finite");
}

// --- growth -------------------------------------------------------------------------------------------------------

TEST(BadInput, Growth) {
    expect_answer("axiom: F\nF --> F\n", "\"drawn\": 1", {"-n", "1000000000"});
    expect_answer("axiom: F+A\nF --> G\nG --> F\nA -->\n", "\"symbols\": 2", {"-n", "1000000000"});
    for (const char* rule : {"A --> AA", "A --> BA", "A --> F[A]", "A --> BAB\nB --> BB"}) {
        const std::string text = "axiom: A\n" + std::string(rule) + "\n";
        expect_refused(piped(text, {"-n", "1000000000"}), 1, "1000000000");
        expect_refused(piped(text, {"-n", "1000000000"}, "derive"), 1, "1000000000");
        expect_refused(drawn(text, {"-n", "1000000000"}), 1, "1000000000");
        expect_refused(piped(text, {"-n", "9223372036854775807"}), 1, "9223372036854775807");
        expect_sane(piped(text, {"-n", "1000000"}));
    }
    expect_refused(drawn("axiom: A\nA --> AFA\n", {"-n", "1000000"}), 1, "about 10^301030");
    // Many symbols over many steps are refused as soon as few are.
    std::string ring = "axiom: a0\nsymbols:";
    std::string rules;
    for (int i = 0; i < 1000; ++i) {
        ring += " a" + std::to_string(i);
        rules += "a" + std::to_string(i) + " --> a" + std::to_string((i + 1) % 1000) + " F\n";
    }
    expect_sane(drawn(ring + "\n" + rules, {"-n", "300000", "--budget", "100000"}));
    expect_sane(piped(ring + "\n" + rules, {"-n", "300000"}));
    // What grows after the contexts is refused as well.
    const std::string after =
        "axiom: ABF\nderivation length: 60\nschedule: once grow*(n-1)\n"
        "table once:\nA < B --> B\ntable grow:\nF --> FF\n";
    expect_refused(drawn(after), 1, "a word of 576460752303423490 symbols (n = 60) is above the budget");
    expect_answer(after, "\"drawn\": \"576460752303423488\"");
    // Where exact counts would take long, the size is told.
    std::string slow = "axiom: a\n";
    const std::string letters = "abcdefghijklmnopqrstuvwxyzGHIJ";
    for (std::size_t i = 0; i < letters.size(); ++i) {
        slow += std::string(1, letters[i]) + " --> " + letters[(i + 1) % letters.size()] + (i == 0 ? "b" : "") + "\n";
    }
    expect_refused(drawn(slow, {"-n", "800000"}), 1, "a word of about 10^8027 symbols");
    // With contexts, the word itself has to stay within the budget.
    expect_refused(drawn("axiom: AB\nA < B --> AB\nB --> BB\n", {"-n", "1000", "--budget", "1e5"}), 1, "");
}

TEST(BadInput, SpiralsOfEveryAngle) {
    for (const char* angle : {"90", "36", "360/7", "12.345", "1e-5", "360/1000003", "0", "180"}) {
        expect_answer("axiom: A\nA --> F+A\nangle increment: " + std::string(angle) + "\n", "\"drawn\": 20000",
                      {"-n", "20000"});
    }
    expect_sane(piped("axiom: A\nA --> F+A\nangle increment: 12.345\n", {"-n", "1000000"}));
}

// --- options ------------------------------------------------------------------------------------------------------

TEST(BadInput, OutputsThatCannotBe) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path() / "folder.svg");
    const auto to = [&](const std::string& output) {
        return run({"draw", "hilbert", "-o", output}, {.folder = folder.path()});
    };
    expect_refused(to("missing/x.svg"), 1, "missing/x.svg");
    expect_refused(to("/proc/x.svg"), 1, "/proc/x.svg");
    expect_refused(to("folder.svg"), 1, "folder.svg");
    expect_refused(to(std::string(5000, 'a') + ".svg"), 1, "name too long");
    for (const char* name : {"x", "x.unknown", ".svg", "", "x.svg/", "x.png.", "/dev/stdout"}) {
        expect_refused(to(name), 2, "-o");
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"folder.svg"});
    EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "folder.svg"));
}

TEST(BadInput, PagesAndLengths) {
    const ScratchFolder folder;
    const auto with = [&](const std::string& option, const std::string& value) {
        SCOPED_TRACE(option + " " + value);
        expect_refused(run({"draw", "hilbert", "-o", folder.file("x.svg"), option, value}), 2, option);
    };
    for (const char* size : {"0mm", "0x0mm", "0x300mm", "10kmx10km", "10km", "10000000x10000000mm", "-5x5mm",
                             "nanxnanmm", "infxinfmm", "1e400x1mm", "A11", "", "x", "mm", "10001x1mm", "0.5x5mm"}) {
        with("--size", size);
    }
    for (const char* step : {"nan", "inf", "nanmm", "-1mm", "0", "0mm", "1e308mm", "", "mm", "5km"}) {
        with("--step", step);
    }
    for (const char* margin : {"nan", "-1mm", "105mm", "200mm", "inf", ""}) with("--margin", margin);
    for (const char* value : {"nan", "inf", "x"}) with("--rotate", value);
    for (const char* value : {"nan", "inf", "0", "-1", "1e9", "x"}) with("--dpi", value);
    for (const char* value : {"nan", "-1", "0", "x"}) with("--budget", value);
    for (const char* value : {"-1", "99999", "x", "1.5"}) with("--jobs", value);
    EXPECT_TRUE(folder.names().empty());
    expect_refused(run({"draw", "hilbert", "-o", folder.file("x.png"), "--size", "10x10m", "--dpi", "9999"}), 2, "");
    expect_refused(run({"draw", "hilbert", "-o", folder.file("x.png"), "--size", "10000x10000mm", "--dpi", "9999"}),
                   2, "pixels");
    for (const char* value : {"1e308", "-1e308", "1e-308"}) {
        expect_sane(run({"draw", "hilbert", "-o", folder.file("x.svg"), "--rotate", value}));
    }
    expect_sane(run({"draw", "hilbert", "-o", folder.file("x.svg"), "--step", "1e-308mm"}));
    expect_sane(run({"draw", "hilbert", "-o", folder.file("x.svg"), "--size", "1x10000mm", "--margin", "0mm"}));
}

TEST(BadInput, Settings) {
    for (const char* setting : {"x", "=", "=5", "axiom", ""}) {
        expect_refused(run({"measure", "hilbert", "--set", setting}), 2, "expected KEY=VALUE");
    }
    for (const char* setting :
         {"n=5", "a=b=c", "axiom=", "derivation length=-1", "derivation length=nan", "seed=x",
          "stroke=", "axiom=F\nF", "axiom=F)", "heading=inf", "\xFF=1", "axiom=\xFF", "axiom=F/*G"}) {
        SCOPED_TRACE(setting);
        expect_refused(run({"measure", "hilbert", "--set", setting}), 2, "--set:1:");
    }
    expect_refused(run({"measure", "hilbert", "-n", "-1"}), 2, "-1");
    expect_refused(run({"measure", "hilbert", "-n", "1000000000"}), 1, "1000000000");
}

TEST(BadInput, UnknownOptionsNameTheNearest) {
    expect_refused(run({"draw", "hilbert", "--siez", "A4", "-o", "x.svg"}), 2,
                   "unknown option '--siez'; did you mean '--size'?");
    expect_refused(run({"play", "hilbert", "--tempi=90"}), 2, "unknown option '--tempi'; did you mean '--tempo'?");
    expect_refused(run({"measure", "hilbert", "--zzzzzzzz"}), 2, "`sikku measure --help` lists the options");
    expect_refused(run({"draw", "hilbert", "again", "-o", "x.svg"}), 2, "unexpected argument 'again'");
}

TEST(BadInput, PicturesAreNotPatterns) {
    const ScratchFolder folder;
    for (const char* name : {"a.svg", "a.png", "a.pdf"}) {
        const std::string file = folder.file(name);
        ASSERT_EQ(run({"draw", "hilbert", "--size", "20x20mm", "--margin", "1mm", "-o", file}).status, 0);
        expect_refused(run({"check", file}), 2,
                       "not a pattern; `sikku show` prints the pattern if Sikku made the file");
    }
}

TEST(BadInput, CheckReadsTheFilesThatKeysName) {
    const ScratchFolder folder;
    for (const std::string key : {"scale: other.scl", "keyboard: m.kbm", "border: nothing", "border: no.lsys",
                                  "surface: x = missing.s", "variant loud: scale = other.scl"}) {
        const std::string file = folder.write("names.lsys", "axiom: FF\nheading: 0\n" + key + "\n");
        EXPECT_EQ(run({"check", file}).status, 2) << key;
    }
    folder.write("other.scl", "! other.scl\nhalves\n 2\n600.0\n2/1\n");
    for (const std::string key : {"scale: other.scl", "border: kaavi", "border: hilbert"}) {
        const std::string file = folder.write("names.lsys", "axiom: FF\nheading: 0\n" + key + "\n");
        EXPECT_EQ(run({"check", file}).output, "") << key;
    }
}

}  // namespace sikku::bad_input_test
