// tests/program/limits_test.cpp: excessive requests are rejected quickly and in little memory, because work is
// counted before anything is expanded; long work stops on request.
#include "engine/derivation/derivation.h"
#include "engine/import/import.h"
#include "tests/program.h"

#include <gtest/gtest.h>

namespace sikku::limits_test {

/// Processor time on a slow machine that does other things as well; what grows without limit takes longer.
constexpr double most_seconds = sanitized ? 60 : 15;
constexpr long most_kilobytes = sanitized ? 4'000'000 : 200 * 1024;

std::string repeated(std::string_view text, std::size_t times) {
    std::string result;
    result.reserve(text.size() * times);
    for (std::size_t i = 0; i < times; ++i) result += text;
    return result;
}

std::string numbered(std::string_view before, std::string_view after, std::size_t count) {
    std::string result;
    for (std::size_t i = 0; i < count; ++i) (result += before) += std::to_string(i) + std::string(after);
    return result;
}

void expect_refused(const Outcome& outcome, std::string_view message) {
    EXPECT_TRUE(outcome.status == 1 || outcome.status == 2) << outcome.status;
    EXPECT_TRUE(has(outcome.errors + outcome.output, message));
    EXPECT_LT(outcome.seconds, most_seconds);
    EXPECT_LT(outcome.peak, most_kilobytes);
    EXPECT_LT(outcome.errors.size(), 30'000u);
}

void expect_refused(const std::string& pattern, std::string_view message,
                    std::initializer_list<const char*> commands = {"check", "measure", "derive"}) {
    for (const char* command : commands) {
        SCOPED_TRACE(command);
        expect_refused(run({command, "-"}, {.input = pattern}), message);
    }
}

/// Asks a program that is at work to stop; it does so soon.
void expect_stops(const std::vector<std::string>& arguments) {
    Child child(arguments);
    child.await_handler(SIGINT);
    child.send(SIGINT);
    const auto asked = std::chrono::steady_clock::now();
    EXPECT_EQ(child.wait().status, 130);
    EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(sanitized ? 60 : 10));
}

// --- engine -----------------------------------------------------------------------------------------------------

const std::string head = "angle factor: 4\nderivation length: 2\n";

TEST(Limits, LongContexts) {
    const std::string context = repeated("A", 100'000);
    expect_refused(head + "axiom: " + context + context + "\n" + context + " < A > " + context + "B --> F\n",
                   "matching contexts compares more than", {"measure", "derive"});
    expect_refused(head + "axiom: " + context + context + "\n" + context + "B --> F\n",
                   "matching contexts compares more than", {"measure", "derive"});
    ScratchFolder folder;
    const std::string pattern =
        folder.write("p.lsys", head + "axiom: " + context + context + "\n" + context + "B --> F\nA --> F\n");
    expect_refused(run({"draw", pattern, "-o", folder.file("x.svg")}), "matching contexts compares more than");
    EXPECT_EQ(folder.names().size(), 1u);
    // One look at a long context, and long contexts that fail at once, cost nothing.
    const Outcome once = run({"measure", "-"}, {.input = head + "axiom: " + repeated("B", 500'000) + "A\n" +
                                                         repeated("B", 400'000) + " < A --> F\n"});
    EXPECT_EQ(once.status, 0) << once.errors;
}

TEST(Limits, ManyProductionsWithContexts) {
    std::string text = head + "axiom: " + repeated("A", 200'000) + "\n";
    for (int point = 0x4E00; point < 0x4E00 + 3000; ++point) {
        text += "A < A > ";
        text += static_cast<char>(0xE0 | (point >> 12));
        text += static_cast<char>(0x80 | ((point >> 6) & 63));
        text += static_cast<char>(0x80 | (point & 63));
        text += " --> F\n";
    }
    expect_refused(text, "matching contexts compares more than", {"measure", "derive"});
}

TEST(Limits, ComparisonsAreCountedBesideAFew) {
    Diagnostics diagnostics;
    const Pattern pattern = parse_pattern(
        "p", "axiom: AAAAAAAAAAAAAAAAAAAAB\nderivation length: 3\nA < A > A --> A\nAA < B --> AB\n", diagnostics);
    const Grammar grammar = compile_grammar(pattern, diagnostics);
    ASSERT_FALSE(diagnostics.has_errors());
    DerivationOptions options;
    options.compared = 0;
    EXPECT_EQ(resolve_contexts(grammar, options).axiom().size(), 24u);
    // A step that compares with every symbol before it is stopped, and asks whether to stop before that.
    const std::string far = repeated("A", 3000);
    const Pattern large =
        parse_pattern("p", "axiom: " + far + "B\nderivation length: 1\n" + far + "A < A --> F\n", diagnostics);
    const Grammar slow = compile_grammar(large, diagnostics);
    ASSERT_FALSE(diagnostics.has_errors());
    int asked = 0;
    options.watch = [&](std::uint64_t) { ++asked; };
    options.compared = 100'000;
    EXPECT_THROW(resolve_contexts(slow, options), BudgetError);
    EXPECT_GE(asked, 1);
    options.compared = 10'000'000;
    EXPECT_NO_THROW(resolve_contexts(slow, options));
}

TEST(Limits, PartsOfAPattern) {
    expect_refused(head + "axiom: F\n" + numbered("table t", ":\nF --> FF\n", 1'000'000), "too many tables");
    expect_refused(head + "axiom: F\n" + numbered("table t", ":\n", 1'000'000), "too many tables");
    expect_refused(head + "axiom: F\n" + numbered("k", ": 1\n", 300'000), "too many keys");
    expect_refused(head + "axiom: F\n" + numbered("define d", " = 1\n", 300'000), "too many defines");
    expect_refused(head + "axiom: F\n" + numbered("variant v", ": heading = 1\n", 100'000), "too many variants");
    expect_refused(head + "axiom: F\nvariant v: " + numbered("k", " = 1,", 200'000) + " l = 1\n",
                   "too many settings");
    expect_refused(head + "axiom: F\nvariant v: " + numbered("k", " = 1,", 2000) + " l = 1\n", "too many keys",
                   {"check"});
    expect_refused(head + "axiom: F\nF --> F\n" + repeated("F --> F\n", 1'100'000), "too many productions");
    expect_refused(head + "axiom: A(" + repeated("1,", 70'000) + "1)\n", "at most 65,536 parameters");
    expect_refused(head + "axiom: F\ntable a:\nF --> F\nschedule: " + repeated("a ", 1'100'000),
                   "at most 1,048,576 entries");
}

TEST(Limits, VariantsOfALargePattern) {
    const std::string axiom = head + "axiom: " + repeated("F", 2'000'000) + "\n";
    expect_refused(axiom + numbered("variant v", ": derivation length = 1\n", 2000), "too many variants", {"check"});
    const Outcome few = run({"check", "-"}, {.input = axiom + numbered("variant v", ": derivation length = 1\n", 3)});
    EXPECT_EQ(few.status, 0) << few.output;
}

TEST(Limits, ChecksOfVariantsStop) {
    ScratchFolder folder;
    expect_stops({"check", folder.write("p.lsys", head + "axiom: " + repeated("F(1+2+3)", 12'000) + "\n" +
                                                      numbered("variant v", ": heading = 1\n", 1500))});
}

TEST(Limits, Generations) {
    ScratchFolder folder;
    const auto draw = [&](const std::string& generations, const char* output, bool frames) {
        std::vector<std::string> words = {"draw", "hilbert", "--generations", generations, "-o", folder.file(output)};
        if (frames) words.emplace_back("--frames");
        return run(words);
    };
    for (const char* generations :
         {"0:9223372036854775807", "9223372036854775807", "9223372036854775800:9223372036854775807"}) {
        SCOPED_TRACE(generations);
        expect_refused(draw(generations, "x.svg", false), "derivation lengths up to 1000000");
        expect_refused(draw(generations, "x.svg", true), "derivation lengths up to 1000000");
        expect_refused(draw(generations, "x.gif", false), "derivation lengths up to 1000000");
    }
    expect_refused(draw("0:10000", "x.svg", true), "up to 10000 derivation lengths");
    EXPECT_TRUE(folder.names().empty());
}

// --- imports ----------------------------------------------------------------------------------------------------

/// Entries that become 500 times as large.
std::string fractint_bomb(std::size_t entries, std::size_t tokens) {
    std::string factors;
    for (int i = 0; i < 16; ++i) factors += "@" + std::to_string(1 + i % 3) + "." + std::to_string(11 + i);
    for (int i = 0; i < 16; ++i) factors += "@I" + std::to_string(1 + i % 3) + "." + std::to_string(51 + i);
    std::string text;
    for (std::size_t i = 0; i < entries; ++i) {
        text += "e" + std::to_string(i) + " {\nAngle 6\nAxiom x\nx=" + factors + repeated("xF", tokens) + "!\n}\n";
    }
    return text;
}

TEST(Limits, FractintEntriesThatGrow) {
    ScratchFolder folder;
    const std::string file = folder.write("bomb.l", fractint_bomb(1500, 300));
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"import", file, "--list"}, {"import", file, "-o", folder.file("out")}}) {
        const Outcome outcome = run(words);
        EXPECT_LT(outcome.seconds, sanitized ? 200 : 60);
        EXPECT_LT(outcome.peak, most_kilobytes);
        EXPECT_TRUE(has(outcome.errors + outcome.output,
                        words.back() == "--list" ? "has errors" : "exceed 16 MB plus twice the size"));
    }
    const std::string large = folder.write("large.l", fractint_bomb(1, 100'000));
    expect_refused(run({"import", large}), "exceeds 4 MB");
}

// --- galleries --------------------------------------------------------------------------------------------------

/// Lists and forecasts a gallery file, or a manifest.
void expect_gallery_refused(const std::string& name, const std::string& text, std::string_view message) {
    ScratchFolder folder;
    const std::string file = folder.write(name, text);
    for (const char* what : {"--list", "--dry-run"}) {
        SCOPED_TRACE(what);
        expect_refused(run({"gallery", name.ends_with(".jsonl") ? "--manifest" : "--file", file, what, "-o",
                            folder.file("out")}),
                       message);
    }
    EXPECT_EQ(folder.names().size(), 1u);
}

TEST(Limits, NestingOfGalleryFiles) {
    for (const std::size_t depth : {60, 50'000}) {
        expect_gallery_refused("g.toml", "set = { a" + repeated(".a", depth) + " = 1 }\n", "too many dots");
        expect_gallery_refused("g.toml", "a" + repeated(".\"a\"", depth) + " = 1\n", "too many dots");
        expect_gallery_refused("g.toml", "[a" + repeated(" . a", depth) + "]\n", "too many dots");
        expect_gallery_refused("g.toml", "size = " + repeated("[", depth), "too many brackets");
        expect_gallery_refused("g.toml", "set = " + repeated("{a=", depth), "too many brackets");
        expect_gallery_refused("g.jsonl", repeated("[", depth), "too many brackets");
        expect_gallery_refused("g.jsonl", repeated("{\"a\":", depth), "too many brackets");
    }
    // Strings and comments are none.
    ScratchFolder folder;
    const std::string dots = repeated("[.", 100);
    const Outcome fine =
        run({"gallery", "--list", "--file",
             folder.write("g.toml", "# " + dots + "\ntitle = \"" + dots + "\\\"" + dots +
                                        "\"\npattern = \"hilbert\" # '" + dots + "\nset = { title = ''' " + dots +
                                        "'' ''', \"source\" = '" + dots + "', description = \"\"\" " + dots +
                                        "\"\" \"\"\" }\n")});
    EXPECT_EQ(fine.status, 0) << fine.errors;
}

TEST(Limits, KeysAndValuesOfGalleryFiles) {
    const std::string pattern = "pattern = \"hilbert\"\n";
    for (const std::size_t keys : {2000, 20'000}) {
        expect_gallery_refused("g.toml", pattern + "set = {" + numbered("k", "=1,", keys) + "l=1}\n",
                               "too many keys");
    }
    for (const std::size_t keys : {5000, 50'000, 200'000}) {
        expect_gallery_refused(
            "g.jsonl", "{\"pattern\": \"hilbert\", \"set\": {" + numbered("\"k", "\":1,", keys) + "\"l\":1}}\n",
            "too many");
    }
    expect_gallery_refused("g.toml", pattern + "n = [" + repeated("1,", 300'000) + "1]\n", "too many values");
    expect_gallery_refused("g.toml", pattern + "# " + repeated("x", 17 << 20) + "\n", "at most 16 MB");
}

TEST(Limits, DefaultsOfManyItems) {
    const std::string items = repeated("[[item]]\npattern = \"hilbert\"\n", 20'000);
    std::string sizes = "size = [";
    for (int i = 0; i < 20'000; ++i) sizes += "\"" + std::to_string(100 + i % 900) + "x100mm\",";
    expect_gallery_refused("g.toml", sizes + "]\n" + items, "this would make");
    // Ranges in lists are not written out.
    expect_gallery_refused("g.toml", "n = [\"0:999998\", 5]\n" + items, "this would make");
    expect_gallery_refused("g.toml", "set = { a = \"0:1e308:1e-308\" }\npattern = \"hilbert\"\n", "this would make");
    // Keys of all items are counted, too.
    expect_gallery_refused("g.toml", "set = {" + numbered("k", "=1,", 900) + "l=1}\n" + items, "too many settings");
}

TEST(Limits, NamesOfGalleries) {
    const std::string pattern = "pattern = \"hilbert\"\n";
    expect_gallery_refused("g.toml", pattern + "name = \"" + repeated("{n}", 20'000) + "\"\n", "is too long");
    expect_gallery_refused("g.toml", pattern + "name = \"" + repeated("{n}", 1'000'000) + "\"\n", "is too long");
    expect_gallery_refused("g.toml",
                           pattern + "name = \"" + repeated("{title}", 140) + "\"\nset = { title = \"" +
                               repeated("y", 200'000) + "\" }\n",
                           "cannot be the name of an output");
}

TEST(Limits, FoldersThatWildcardsFind) {
    ScratchFolder folder;
    const std::string text = "axiom: F\n";
    for (const char* name : {"a", "b"}) {
        std::filesystem::create_directory(folder / name);
        folder.write(std::string(name) + "/x" + name + ".lsys", text);
    }
    folder.write("ab.lsys", text);
    folder.write("a[b.lsys", text);
    folder.write(".hidden.lsys", text);
    const auto list = [&](const std::string& pattern) {
        const std::string file = folder.write("g.toml", "pattern = '" + pattern + "'\n");
        const Outcome outcome = run({"gallery", "--list", "--file", file});
        EXPECT_LT(outcome.seconds, most_seconds);
        std::string names;
        for (std::size_t at = 0; at < outcome.output.size(); at = outcome.output.find('\n', at) + 1) {
            names += outcome.output.substr(at, outcome.output.find(' ', at) - at) + " ";
        }
        return outcome.status == 0 ? names : outcome.errors;
    };
    EXPECT_EQ(list("*.lsys"), "a-b.svg ab.svg ");
    EXPECT_EQ(list("*/*.lsys"), "xa.svg xb.svg ");
    EXPECT_EQ(list("[!b]/x?.lsys"), "xa.svg ");
    EXPECT_EQ(list("[b-z]/../a/x[abc].lsys"), "xa.svg ");
    EXPECT_EQ(list("a\\[*.lsys"), "a-b.svg ");
    EXPECT_EQ(list("?b.lsys"), "ab.svg ");
    // Folders that are reached in many ways are entered once.
    EXPECT_EQ(list(repeated("*/../", 40) + "*/*.lsys"), "xa.svg xb.svg ");
    EXPECT_TRUE(has(list(repeated("*a", 400) + "b"), "no pattern matches"));
    expect_refused(run({"gallery", "--list", "/" + repeated("*/../", 30) + "*.no"}), "no pattern matches");
}

TEST(Limits, TheSettingThatSpoilsAPatternIsFound) {
    ScratchFolder folder;
    const Outcome outcome =
        run({"gallery", "--list", "--file",
             folder.write("g.toml",
                          "pattern = \"hilbert\"\n\n[set]\n\"derivation length\" = 2\ntitle = \"x\"\nwrong = 1\n"
                          "heading = 0\nalso = 2\n")});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(has(outcome.errors, "g.toml:6:1: set:1:1: unknown key 'wrong'"));
    EXPECT_FALSE(has(outcome.errors, "'also'"));
}

TEST(Limits, PlacesOfKeysInALine) {
    ScratchFolder folder;
    const Outcome outcome =
        run({"gallery", "--list", "--manifest",
             folder.write("g.jsonl",
                          "{\"pattern\": \"hilbert\", \"name\": \"dpi \\\" ä\", \"set\": {\"title\": "
                          "\"dpi\"}, \"dpi\": \"x\"}\n")});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(has(outcome.errors, "g.jsonl:1:69: dpi: expected a number"));
}

TEST(Limits, LongListsOfJobsStop) {
    ScratchFolder folder;
    expect_stops(
        {"gallery", "--list", "--file", folder.write("g.toml", "pattern = \"hilbert\"\nseeds = \"0:999999\"\n")});
}

TEST(Limits, GalleryFilesOfTheCorpus) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(SIKKU_SOURCE_DIR) / "tests/corpus/gallery")) {
        SCOPED_TRACE(entry.path().string());
        const bool is_manifest = entry.path().extension() == ".jsonl";
        const Outcome outcome =
            run({"gallery", "--list", is_manifest ? "--manifest" : "--file", entry.path().string()});
        const bool is_good = entry.path().stem() == "items" || entry.path().stem() == "jobs";
        EXPECT_EQ(outcome.status, is_good ? 0 : 2) << outcome.errors;
        EXPECT_LT(outcome.seconds, most_seconds);
    }
}

TEST(Limits, OfDronesGenerationsAndWindows) {
    const ScratchFolder folder;
    const Outcome drone = run({"play", "-", "-n", "21", "-o", folder.file("a.mid")},
                              {.input = "axiom: F+F-F\nF --> FF\nunit: 1/1\nharmony: drone\nloop: 2\n"});
    EXPECT_NE(drone.status, 0);
    EXPECT_TRUE(has(drone.errors, "the drone would have more than 4000000 notes"));
    expect_refused(run({"draw", "penrose-rhombs", "--divide", "-n", "500000000", "-o", folder.file("a.svg")}),
                   "generations are derived up to n = 10000, not to 500000000");
    // Branches of X vanish, but there are 2^60 of them.
    expect_refused(run({"draw", "-", "--window=0,0,1,1", "-o", folder.file("b.svg")},
                       {.input = "derivation length: 60\nangle increment: 90\naxiom: Y\nX --> XX\n"
                                 "Y --> X{F+F+F+F}fYY\ninterpret:\nX -->\n"}),
                   "");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace sikku::limits_test
