// tests/program/cli_test.cpp: the program as seen by its users: commands, exit statuses, outputs, signals.
#include "tests/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

namespace sikku::cli_test {

using Json = nlohmann::json;

std::string derived(const std::string& pattern, std::vector<std::string> arguments = {}) {
    arguments.insert(arguments.begin(), {"derive", "-"});
    const Outcome outcome = run(arguments, {.input = pattern});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    return outcome.output;
}

void expect_failure(const Outcome& outcome, int status, std::string_view message) {
    EXPECT_EQ(outcome.status, status) << outcome.errors;
    EXPECT_TRUE(has(outcome.errors, message));
    EXPECT_EQ(outcome.output, "");
}

// --- help, usage, names -------------------------------------------------------------------------------------------

TEST(Program, EveryCommandHasHelpWithExamples) {
    const Outcome all = run({"--help"});
    EXPECT_EQ(all.status, 0);
    for (const char* command : {"draw", "derive", "measure", "patterns", "show", "check", "completion"}) {
        EXPECT_TRUE(has(all.output, command));
        const Outcome help = run({command, "--help"});
        EXPECT_EQ(help.status, 0) << command;
        EXPECT_TRUE(has(help.output, "Examples:\n  sikku " + std::string(command))) << command;
        EXPECT_EQ(help.errors, "") << command;
    }
    static const std::regex version(R"(sikku \d+\.\d+\.\d+( \([0-9a-f]{12}(, with changes)?\))?\n)");
    const std::string said = run({"--version"}).output;
    EXPECT_TRUE(std::regex_match(said, version)) << said;
}

TEST(Program, WrongUsageIsTwo) {
    const std::vector<std::vector<std::string>> wrong = {{"paint", "hilbert"},
                                                         {"measure"},
                                                         {"measure", "hilbert", "more"},
                                                         {"measure", "hilbert", "--nonsense"},
                                                         {"measure", "hilbert", "-n", "x"},
                                                         {"measure", "hilbert", "-n", "-1"},
                                                         {"measure", "hilbert", "-n", "1.5"},
                                                         {"measure", "hilbert", "-n", "9223372036854775808"},
                                                         {"measure", "hilbert", "--set", "x"},
                                                         {"measure", "hilbert", "--set", "=1"},
                                                         {"measure", "hilbert", "--set", "nonsense=1"},
                                                         {"measure", "hilbert", "--variant", "nonsense"},
                                                         {"draw", "hilbert"},
                                                         {"draw", "hilbert", "-o", "x.unknown"},
                                                         {"draw", "hilbert", "-o", "x.svg", "--fit", "--step", "5mm"},
                                                         {"completion", "csh"},
                                                         {"patterns", "nonsense"},
                                                         {"show"},
                                                         {"check"}};
    const ScratchFolder folder;
    for (const auto& arguments : wrong) {
        const Outcome outcome = run(arguments, {.folder = folder.path()});
        std::string line = "sikku";
        for (const std::string& argument : arguments) line += " " + argument;
        EXPECT_EQ(outcome.status, 2) << line << "\n" << outcome.errors;
        EXPECT_NE(outcome.errors, "") << line;
        EXPECT_EQ(outcome.output, "") << line;
    }
    EXPECT_TRUE(folder.names().empty());
    // Without a command, the help.
    EXPECT_EQ(run({}).status, 2);
    EXPECT_EQ(run({}).output, run({"--help"}).output);
}

TEST(Program, EveryMessageSaysWhoSpeaks) {
    for (const auto& arguments : std::vector<std::vector<std::string>>{{"--nonsense"},
                                                                       {"measure"},
                                                                       {"measure", "hilbert", "--nonsense"},
                                                                       {"measure", "nosuch"},
                                                                       {"draw", "hilbert", "-o", "x.svg", "-j", "x"},
                                                                       {"completion", "csh"},
                                                                       {"patterns", "nonsense"}}) {
        EXPECT_EQ(run(arguments).errors.substr(0, 7), "sikku: ");
    }
    const std::string shown = run({"measure", "hilbert", "--\x1b[31m\xff"}).errors;
    EXPECT_TRUE(has(shown, "--?[31m?")) << "a terminal is left alone";
}

TEST(Program, UnknownCommandsAreNamed) {
    EXPECT_TRUE(has(run({"paint", "hilbert"}).errors, "paint"));
}

TEST(Program, NamesNearToKnownOnesAreSuggested) {
    expect_failure(run({"-q"}), 2, "a command is missing; `sikku --help` lists them");
    expect_failure(run({"measure", "hilbrt"}), 2, "did you mean 'hilbert'");
    expect_failure(run({"measure", "snake-kolan"}), 2, "did you mean 'snake-kolam'");
    expect_failure(run({"measure", "qqqqqqqqqqqq"}), 2, "sikku patterns");
    expect_failure(run({"measure", "-"}, {.input = "axim: F"}), 2, "did you mean 'axiom'");
    expect_failure(run({"play", "-", "-o", "x.mid"}, {.input = "tempo = 90\n[[track]]\npattern = 'hilbert'\n"}), 2,
                   "-: this is an arrangement");
    expect_failure(run({"sheet", "-", "-", "-o", "x.svg"}, {.input = "axiom: F"}), 2,
                   "-: standard input can be read only once");
    const Outcome open = run({"check", "-"}, {.input = "axiom: A\nderivation length: 2\nA --> F{F+FA\n"});
    EXPECT_EQ(open.status, 2);
    EXPECT_TRUE(has(open.output, "-:3:7: the word has a '{' that is not closed"));
    expect_failure(run({"measure", "hilbert", "--set", "strok=1mm"}), 2, "did you mean 'stroke'");
    expect_failure(run({"patterns", "plant"}), 2, "unknown kind of patterns 'plant'; did you mean 'plants'?");
    expect_failure(run({"patterns", "klams"}), 2, "did you mean 'kolams'?");
    expect_failure(run({"patterns", "qqqqqqqqqqqq"}), 2,
                   "there are: arrangements, curves, kolam-library, kolams, maps, melodies, plants, tilings, words");
}

TEST(Program, MistakesAreToldWithPlaceLineAndCaret) {
    const ScratchFolder folder;
    const std::string file = folder.write("wrong.lsys", "axiom: F\nnonsense: 1\nF --> F)G\n");
    const Outcome outcome = run({"measure", file});
    expect_failure(outcome, 2, file + ":2:1: ");
    EXPECT_TRUE(has(outcome.errors, file + ":3:8: ')' without '('\nF --> F)G\n       ^\n"));
    // check prints the same, on standard output.
    const Outcome checked = run({"check", file});
    EXPECT_EQ(checked.status, 2);
    EXPECT_TRUE(has(checked.output, file + ":3:8: "));
    EXPECT_EQ(run({"check", "hilbert", "snake-kolam"}).output, "");
}

TEST(Program, EveryPatternThatComesAlongPassesItsCheck) {
    const Outcome names = run({"patterns", "--names"});
    std::vector<std::string> arguments = {"check"};
    std::string name;
    for (const char byte : names.output) {
        if (byte != '\n') {
            name += byte;
            continue;
        }
        arguments.push_back(name);
        name.clear();
    }
    EXPECT_GT(arguments.size(), 50U);
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.output, "");
    for (const char* kind : {"kolams", "tilings", "curves", "plants", "words"}) {
        EXPECT_TRUE(has(run({"patterns"}).output, std::string(kind) + "\n"));
        EXPECT_EQ(run({"patterns", kind}).status, 0);
    }
}

/// Names and titles of any length leave the columns straight.
TEST(Program, PatternsAreListedInColumns) {
    for (const char* kind : {"kolams", "tilings", "curves", "plants", "words", "melodies"}) {
        std::istringstream lines(run({"patterns", kind}).output);
        std::string line;
        std::getline(lines, line);
        std::set<std::size_t> titles;
        while (std::getline(lines, line)) titles.insert(line.find_first_not_of(' ', line.find(' ', 2)));
        EXPECT_EQ(titles.size(), 1u) << kind;
    }
}

TEST(Program, MessagesThatCannotBeToldChangeNoStatus) {
    const ScratchFolder folder;
    const auto status = [&](const std::vector<std::string>& arguments, const std::string& input = "") {
        return run(arguments, {.input = input, .folder = folder.path(), .errors = "/dev/full"}).status;
    };
    EXPECT_EQ(status({"draw", "nosuch", "-o", "x.svg"}), 2);
    EXPECT_EQ(status({"measure", "-"}, "axiom: F)\n"), 2);
    EXPECT_EQ(status({"measure", "-"}, "axiom: F]\n"), 2);
    EXPECT_EQ(status({"measure", "--nonsense"}), 2);
    EXPECT_EQ(status({"draw", "hilbert", "-n", "40", "-o", "x.svg"}), 1);
    EXPECT_EQ(status({"derive", "-"}, "axiom: F // F\n"), 0) << "a warning";
    EXPECT_EQ(status({"draw", "hilbert", "-o", "x.svg"}), 0);
    EXPECT_EQ(status({"show", "x.svg"}), 0);
}

TEST(Program, OutputThatIsLostIsAFailure) {
    const ScratchFolder folder;
    const std::string wrong = folder.write("wrong.lsys", "axiom: F)\n");
    const std::string large = folder.write("large.lsys", "axiom: F\n" + std::string(100'000, '\n'));
    for (const auto& arguments : std::vector<std::vector<std::string>>{{"show", "snake-kolam"},
                                                                       {"show", large},
                                                                       {"patterns"},
                                                                       {"patterns", "--names"},
                                                                       {"measure", "hilbert"},
                                                                       {"measure", "hilbert", "--json"},
                                                                       {"derive", "hilbert"},
                                                                       {"check", wrong},
                                                                       {"completion", "bash"},
                                                                       {"completion", "zsh"},
                                                                       {"--help"},
                                                                       {"draw", "--help"},
                                                                       {"--version"}}) {
        const Outcome outcome = run(arguments, {.output = "/dev/full"});
        EXPECT_EQ(outcome.status, 1) << arguments.front();
        EXPECT_TRUE(has(outcome.errors, "sikku: cannot write to standard output")) << arguments.front();
        EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    }
    // Where nothing is printed nothing is lost.
    EXPECT_EQ(run({"check", "hilbert"}, {.output = "/dev/full"}).status, 0);
    EXPECT_EQ(run({"measure", "nosuch"}, {.output = "/dev/full"}).status, 2);
}

TEST(Program, OnlyPatternsOfItsVersionAreUsed) {
    const ScratchFolder folder;
    const std::string data = folder.path().string();
    const auto refused = [&](const std::string& place, std::vector<std::string> arguments) {
        const Outcome outcome =
            run(std::move(arguments), {.folder = folder.path(), .environment = {{"SIKKU_DATA", place}}});
        EXPECT_EQ(outcome.status, 2);
        return outcome.errors;
    };
    const std::string none = "/nowhere/patterns (SIKKU_DATA) contains no patterns\n";
    EXPECT_EQ(refused("/nowhere", {"measure", "hilbert"}), "sikku: no file is named 'hilbert', and " + none);
    EXPECT_EQ(refused("/nowhere", {"gallery", "hilbert"}), "sikku: no file is named 'hilbert', and " + none);
    EXPECT_EQ(refused("/nowhere", {"patterns"}), "sikku: " + none);
    EXPECT_EQ(refused("/nowhere", {"gallery"}), "sikku: " + none);
    EXPECT_EQ(refused("/nowhere", {"patterns", "arrangements"}), "sikku: " + none);
    EXPECT_TRUE(has(refused("/nowhere", {"gallery", "--file", "tilings"}), none));
    EXPECT_TRUE(has(refused("/nowhere", {"gallery", "h*"}), none));
    std::filesystem::create_directory(folder.path() / "patterns");
    folder.write("patterns/mine.lsys", "axiom: F\n");
    const std::vector<std::string> measure = {"measure", "mine"};
    const Surroundings here{.folder = "/", .environment = {{"SIKKU_DATA", data}}};
    EXPECT_EQ(run(measure, here).status, 0);
    folder.write("version", "0.0.1\r\n");
    // Arrangements in the current folder are not listed.
    std::filesystem::create_directory(folder.path() / "arrangements");
    folder.write("arrangements/duet.toml", "title = \"not bundled\"\n");
    EXPECT_TRUE(has(refused(data, {"patterns", "arrangements"}), "belong to sikku 0.0.1"));
    EXPECT_TRUE(has(run({"studio", "-o", "x.html"}, here).errors, "belong to sikku 0.0.1"));
    EXPECT_TRUE(has(refused(data, measure),
                    "the patterns in " + data + " (SIKKU_DATA) belong to sikku 0.0.1, but this is sikku "));
    const Outcome version = run({"--version"});
    folder.write("version", version.output.substr(6, version.output.find(' ', 6) - 6) + "\n");
    EXPECT_EQ(run(measure, here).status, 0) << version.output;
}

TEST(Program, AFolderForTemporaryFilesThatIsMissing) {
    const ScratchFolder folder;
    const std::string program = folder.write("lilypond", "#!/bin/sh\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    const Outcome outcome = run({"play", "hilbert", "-o", folder.file("x.pdf")},
                                {.environment = {{"PATH", folder.path().string()}, {"TMPDIR", "/nowhere"}}});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "sikku: the folder for temporary files cannot be used (TMPDIR is '/nowhere')"))
        << outcome.errors;
}

TEST(Program, PatternsAreFoundFromAnywhere) {
    const ScratchFolder folder;
    EXPECT_EQ(run({"measure", "hilbert"}, {.folder = folder.path()}).status, 0);
    EXPECT_EQ(run({"measure", "hilbert"}, {.folder = "/"}).status, 0);
    // Through a link to the program, too, and through PATH.
    std::filesystem::create_symlink(SIKKU_PROGRAM, folder.path() / "linked");
    EXPECT_EQ(run({"measure", "hilbert"}, {.program = folder.file("linked")}).status, 0);
    const std::string bin = std::filesystem::path(SIKKU_PROGRAM).parent_path().string();
    EXPECT_EQ(run({"measure", "hilbert"}, {.environment = {{"PATH", bin}}, .program = "sikku"}).status, 0);
}

TEST(Program, PathsNamesAndStandardInput) {
    const ScratchFolder folder;
    folder.write("own.lsys", "title: Own\naxiom: F");
    folder.write("hilbert", "title: A file called hilbert\naxiom: F");
    const auto title = [&](const std::string& pattern) {
        return run({"measure", pattern}, {.folder = folder.path()}).output;
    };
    EXPECT_TRUE(has(title("own.lsys"), "Own, n = 0"));
    EXPECT_TRUE(has(title("./own.lsys"), "Own, n = 0"));
    EXPECT_TRUE(has(title("hilbert"), "A file called hilbert")) << "a file goes before a name";
    std::filesystem::remove(folder.path() / "hilbert");
    std::filesystem::create_directory(folder.path() / "hilbert");
    EXPECT_TRUE(has(title("hilbert"), "Hilbert curve")) << "a folder is no pattern";
    EXPECT_TRUE(has(run({"measure", "-"}, {.input = "title: Piped\naxiom: F"}).output, "Piped, n = 0"));
    expect_failure(run({"measure", "missing.lsys"}), 2, "missing.lsys");
    expect_failure(run({"measure", folder.path().string()}), 2, "is a folder");
}

// --- settings -----------------------------------------------------------------------------------------------------

TEST(Program, FileIsOverriddenByVariantBySetByN) {
    const std::string text =
        "derivation length: 1\ndefine r = 1\naxiom: F(r)\nF --> F\nvariant v: derivation length = 2, r = 2\n";
    const auto n_and_length = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"measure", "--json", "-"});
        const Json json = Json::parse(run(arguments, {.input = text}).output);
        return json["n"].dump() + " " + json["length"].dump();
    };
    EXPECT_EQ(n_and_length({}), "1 1.0");
    EXPECT_EQ(n_and_length({"--variant", "v"}), "2 2.0");
    EXPECT_EQ(n_and_length({"--variant", "v", "--set", "derivation length=3"}), "3 2.0");
    EXPECT_EQ(n_and_length({"--variant", "v", "--set", "r=5", "--set", "Derivation  Length=3"}), "3 5.0");
    EXPECT_EQ(n_and_length({"-n", "4", "--variant", "v", "--set", "derivation length=3"}), "4 2.0");
    expect_failure(run({"measure", "-", "--variant", "w"}, {.input = text}), 2, "--variant w: unknown variant");
    EXPECT_TRUE(
        has(run({"measure", "hilbert", "-n", "2", "--set", "axiom=F=F", "--set", "ignore==", "--json"}).output,
            "\"n\": 2, "));
    expect_failure(run({"measure", "-"}, {.input = "axiom: F(1e308)F(1e308)\n"}), 2, "range of its coordinates");
}

// --- derive -------------------------------------------------------------------------------------------------------

TEST(Program, DerivePrintsTheWordAndOneNewline) {
    EXPECT_EQ(derived("axiom: a\na --> ab\nb --> a\n", {"-n", "5"}), "abaababaabaab\n");
    EXPECT_EQ(derived("axiom:   F + F  \n"), "F+F\n");
    EXPECT_EQ(derived("axiom: A\nA --> *\n", {"-n", "1"}), "\n");
    EXPECT_EQ(derived("symbols: ar al\naxiom: ar al+al\n"), "ar al + al\n");
    EXPECT_EQ(derived("symbols: ab\naxiom: a bab\n"), "a b ab\n");
    EXPECT_EQ(derived("axiom: A(1,0.50)F(1/3)+(-60)@O(1e30)\n"), "A(1,0.5)F(0.3333333333333333)+(-60)@O(1e+30)\n");
    EXPECT_EQ(derived("axiom: X\ninterpret:\nX --> FF\n"), "X\n");
    EXPECT_EQ(derived("axiom: X\ninterpret:\nX --> FF\n", {"--interpreted"}), "FF\n");
}

TEST(Program, DerivedWordsReadBack) {
    const std::vector<std::string> heads = {"", "symbols: Fl Fr ab\n", "symbols: a aa aaa\n"};
    for (const std::string& head : heads) {
        const std::string word = derived(head + "axiom: Fl F l Fr(0.1,1e-300)A(1)rF a b aba a a a @O(2)F\n");
        EXPECT_EQ(derived(head + "axiom: " + word), word);
    }
}

TEST(Program, DeriveToAPipeThatIsClosedOrADiskThatIsFull) {
    const Outcome full = run({"derive", "hilbert", "-n", "9"}, {.output = "/dev/full"});
    EXPECT_EQ(full.status, 1);
    EXPECT_NE(full.errors, "");
    const Outcome measured_full = run({"measure", "hilbert"}, {.output = "/dev/full"});
    EXPECT_EQ(measured_full.status, 1);
    EXPECT_NE(measured_full.errors, "");
    EXPECT_EQ(run({"-c", "\"$0\" derive koch-island -n 8 | head -c 100", SIKKU_PROGRAM}, {.program = "bash"}).status,
              0);
}

// --- show ---------------------------------------------------------------------------------------------------------

TEST(Program, ShowPrintsThePatternAlsoOfAPrint) {
    const std::string text = run({"show", "snake-kolam"}).output;
    EXPECT_EQ(text, contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/kolams/snake-kolam.lsys"));
    const ScratchFolder folder;
    for (const char* name : {"print.svg", "print.pdf", "print.PDF", "print.png"}) {
        ASSERT_EQ(run({"draw", "snake-kolam", "--dpi", "50", "-o", folder.file(name)}).status, 0) << name;
        const Outcome shown = run({"show", folder.file(name)});
        EXPECT_EQ(shown.status, 0) << shown.errors;
        EXPECT_EQ(shown.output, text) << name;
        EXPECT_TRUE(has(shown.errors, "made with sikku"));
        EXPECT_EQ(run({"show", "--quiet", folder.file(name)}).errors, "");
    }
    // A missing file is said to be missing.
    for (const char* empty : {"empty.png", "empty.lsys"}) {
        expect_failure(run({"show", folder.write(empty, "")}), 1, std::string(empty) + ": this file is empty");
    }
    EXPECT_TRUE(has(run({"show", folder.file("missing.svg")}).errors, "No such file"));
    EXPECT_TRUE(has(run({"show", folder.file("missing.png")}).errors, "No such file"));
    EXPECT_TRUE(has(run({"show", folder.file("missing.pdf")}).errors, "No such file"));
    EXPECT_EQ(run({"show", folder.write("other.svg", "<svg/>")}).status, 1);
    expect_failure(run({"show", folder.write("other.pdf", "%PDF-1.4\n")}), 1, "this PDF file contains no pattern");
    ASSERT_EQ(run({"play", "hilbert", "-n", "2", "-o", folder.file("page.html")}).status, 0);
    EXPECT_TRUE(has(run({"show", folder.file("page.html")}).output, "title: Hilbert curve"));
    ASSERT_EQ(run({"play", "hilbert", "-n", "2", "-o", folder.file("score.musicxml")}).status, 0);
    EXPECT_TRUE(has(run({"show", folder.file("score.musicxml")}).output, "title: Hilbert curve"));
    // Any text comes back as it was, beyond ASCII and with the line ends of others.
    const std::string words = "title: கோலம் (1) \\ \"x\"\r\naxiom: F(1)\\F \\\r\n+F\r\n";
    for (const char* name : {"words.svg", "words.pdf", "words.png"}) {
        ASSERT_EQ(run({"draw", "-", "--dpi", "20", "-o", folder.file(name)}, {.input = words}).status, 0);
        EXPECT_EQ(run({"show", "-q", folder.file(name)}).output, words) << name;
    }
}

// --- draw ---------------------------------------------------------------------------------------------------------

TEST(Program, DrawWritesEveryKind) {
    const ScratchFolder folder;
    const std::vector<std::pair<std::string, std::string>> kinds = {
        {"a.svg", "<?xml"}, {"a.SVG", "<?xml"}, {"a.pdf", "%PDF-"},    {"a.png", "\x89PNG"},
        {"a.tif", "II*"},   {"a.tiff", "II*"},  {"a.jpg", "\xFF\xD8"}, {"a.exr", "\x76\x2F\x31\x01"}};
    for (const auto& [name, head] : kinds) {
        const Outcome outcome = run({"draw", "hilbert", "-o", folder.file(name), "--dpi", "40"});
        EXPECT_EQ(outcome.status, 0) << name << outcome.errors;
        const bool has_pixels = head != "<?xml" && head != "%PDF-";
        const std::string no_pixels = has_pixels ? "" : "sikku: warning: --dpi has no effect: ";
        EXPECT_EQ((outcome.output + outcome.errors).substr(0, no_pixels.size() + (has_pixels ? 1 : 0)), no_pixels)
            << name;
        EXPECT_EQ(contents(folder.file(name)).substr(0, head.size()), head) << name;
    }
    EXPECT_EQ(folder.names().size(), kinds.size()) << "nothing is left beside the prints";
}

TEST(Program, AFolderIsNoPrint) {
    const ScratchFolder folder;
    const std::string path = folder.file("folder");
    std::filesystem::create_directory(path);
    expect_failure(run({"draw", "hilbert", "-o", path}), 2, "this is a folder");
    expect_failure(run({"draw", "hilbert", "-o", path + "/"}), 2, path + "/print.svg");
}

TEST(Program, TheSameBytesEveryTime) {
    const ScratchFolder folder;
    std::vector<std::vector<std::pair<std::string, std::string>>> worlds = {
        {},
        {{"LC_ALL", "de_DE.UTF-8"}, {"LANG", "de_DE.UTF-8"}},
        {{"LC_ALL", "C"}, {"TZ", "Asia/Kolkata"}, {"SOURCE_DATE_EPOCH", "1"}}};
    // The search for leaks may itself crash over the threads that OpenImageIO leaves behind.
    for (auto& world : worlds) {
        if (sanitized) world.emplace_back("ASAN_OPTIONS", "detect_leaks=0");
    }
    for (const char* ending : {".svg", ".pdf", ".png", ".tif", ".jpg"}) {
        std::set<std::string> seen;
        for (std::size_t i = 0; i < worlds.size(); ++i) {
            const std::string file = folder.file(std::to_string(i) + ending);
            const Outcome outcome = run({"draw", "plant-d", "-o", file, "--dpi", "50", "-j", std::to_string(i)},
                                        {.environment = worlds[i]});
            ASSERT_EQ(outcome.status, 0) << outcome.errors;
            seen.insert(contents(file));
        }
        EXPECT_EQ(seen.size(), 1U) << ending;
    }
    for (const auto& command : std::vector<std::vector<std::string>>{
             {"measure", "plant-d"}, {"measure", "--json", "plant-d"}, {"derive", "plant-d"}, {"patterns"}}) {
        std::set<std::string> seen;
        for (const auto& world : worlds) seen.insert(run(command, {.environment = world}).output);
        EXPECT_EQ(seen.size(), 1U) << command.front();
    }
}

TEST(Program, GrowthThatCannotBePaidForIsRefusedAtOnce) {
    const ScratchFolder folder;
    const Outcome outcome = run({"draw", "hilbert", "-n", "40", "-o", folder.file("x.svg")});
    expect_failure(outcome, 1, "4029752732048763915687251");
    EXPECT_TRUE(has(outcome.errors, "largest derivation length that fits is 12"));
    EXPECT_LT(outcome.seconds, sanitized ? 2 : 0.2);
    const Outcome huge = run({"draw", "hilbert", "-n", "40000", "-o", folder.file("x.svg")});
    expect_failure(huge, 1, "about 10^24082");
    EXPECT_LT(huge.seconds, sanitized ? 5 : 0.5);
    const Outcome small = run({"draw", "hilbert", "--budget", "1000", "-o", folder.file("x.svg")});
    expect_failure(small, 1, "largest derivation length that fits is 4");
    EXPECT_EQ(run({"draw", "hilbert", "-n", "4", "--budget", "1000", "-o", folder.file("y.svg")}).status, 0);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"y.svg"});
    // A pipe has no budget.
    EXPECT_EQ(
        run({"-c", "\"$0\" derive hilbert -n 40 | head -c 100000000 | wc -c", SIKKU_PROGRAM}, {.program = "bash"})
            .output,
        "100000000\n");
}

TEST(Program, WhatWasThereSurvivesAFailure) {
    const ScratchFolder folder;
    const auto keeps = [&](const std::vector<std::string>& arguments, int status, Surroundings surroundings = {}) {
        const std::string file = folder.write("print.svg", "what was there");
        std::vector<std::string> all = {"draw", "-o", file};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Outcome outcome = run(all, std::move(surroundings));
        EXPECT_EQ(outcome.status, status) << outcome.errors;
        EXPECT_NE(outcome.errors, "");
        EXPECT_EQ(contents(file), "what was there");
        EXPECT_EQ(folder.names(), std::vector<std::string>{"print.svg"});
    };
    keeps({"hilbert", "-n", "40"}, 1);
    keeps({"-"}, 2, {.input = "axiom: F]"});
    keeps({"-"}, 2, {.input = "axiom: FF@O(1/0)"});
    keeps({"-"}, 1, {.input = "axiom: A"});
    keeps({"-"}, 2, {.input = "axiom: F --> F"});
    keeps({"hilbert", "--size", "0x0mm"}, 2);
    // A disk that is full after 100 kB.
    keeps({"hilbert", "-n", "9"}, 1, {.file_size = 100'000});
    // A folder that cannot be written to, and one that is not there.
    EXPECT_EQ(run({"draw", "hilbert", "-o", folder.file("missing/print.svg")}).status, 1);
    EXPECT_EQ(run({"draw", "hilbert", "-o", "/proc/print.svg"}).status, 1);
}

TEST(Program, AFullDiskLeavesNoFileOfAnyKind) {
    for (const char* name : {"a.svg", "a.pdf", "a.png", "a.tif"}) {
        const ScratchFolder folder;
        const Outcome outcome =
            run({"draw", "hilbert", "-n", "9", "--dpi", "300", "-o", folder.file(name)}, {.file_size = 20'000});
        EXPECT_EQ(outcome.status, 1) << name << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, folder.file(name))) << "the message names the file";
        EXPECT_TRUE(folder.names().empty()) << name;
    }
}

TEST(Program, ModesAndLinksAreKept) {
    const ScratchFolder folder;
    const std::string file = folder.write("print.svg", "old");
    std::filesystem::permissions(file, std::filesystem::perms(0640));
    std::filesystem::create_symlink("print.svg", folder.path() / "link.svg");
    ASSERT_EQ(run({"draw", "hilbert", "-o", folder.file("link.svg")}).status, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.svg"));
    EXPECT_EQ(contents(file).substr(0, 5), "<?xml");
    EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms(0640));
}

void interrupt_in_mid_work(int signal, const char* name) {
    const ScratchFolder folder;
    Child child({"draw", "koch-island", "-n", "10", "--budget", "1e15", "-o", name}, {.folder = folder.path()});
    for (int i = 0; i < 2000 && folder.names().empty(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_FALSE(folder.names().empty()) << "it never began to write";
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    child.send(signal);
    const auto sent = std::chrono::steady_clock::now();
    const Outcome outcome = child.wait();
    EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(5));
    EXPECT_EQ(outcome.status, 128 + signal);
    EXPECT_TRUE(has(outcome.errors, "interrupted"));
    EXPECT_TRUE(folder.names().empty()) << folder.names().front();
}

TEST(Program, ControlCLeavesNothing) {
    interrupt_in_mid_work(SIGINT, "print.svg");
    interrupt_in_mid_work(SIGTERM, "print.svg");
    interrupt_in_mid_work(SIGINT, "print.pdf");
}

TEST(Program, ControlCLeavesWhatWasThere) {
    const ScratchFolder folder;
    const std::string file = folder.write("print.svg", "what was there");
    Child child({"draw", "koch-island", "-n", "10", "--budget", "1e15", "-o", file});
    for (int i = 0; i < 2000 && folder.names().size() < 2; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    child.send(SIGINT);
    EXPECT_NE(child.wait().status, 0);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"print.svg"});
    EXPECT_EQ(contents(file), "what was there");
}

TEST(Program, ControlCWhileInputIsAwaited) {
    for (const auto& [start, arguments] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"", {"draw", "-", "-o", "x.svg"}}, {"axiom: F", {"measure", "-"}}, {"", {"check", "-"}}}) {
        const ScratchFolder folder;
        Child* running = nullptr;
        Child child(arguments,
                    {.feed =
                         [&, text = start](const Feed& feed) {
                             feed(text);
                             running->await_handler(SIGINT);
                             running->send(SIGINT);
                             // Input ends only after the program has had its time to answer.
                             std::this_thread::sleep_for(std::chrono::milliseconds(sanitized ? 1000 : 300));
                         },
                     .folder = folder.path()});
        running = &child;
        const Outcome outcome = child.wait();
        EXPECT_EQ(outcome.status, 130) << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, "sikku: interrupted"));
        EXPECT_EQ(outcome.output, "");
        EXPECT_TRUE(folder.names().empty());
    }
}

TEST(Program, ControlCInMidWordSaysOnlyThat) {
    Child child({"derive", "koch-island", "-n", "30"}, {.output = "/dev/null"});
    child.await_handler(SIGINT);
    child.send(SIGINT);
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.status, 130);
    EXPECT_EQ(outcome.errors, "sikku: interrupted\n") << "part of the word is printed already";
}

TEST(Program, NoProgressIntoAPipe) {
    const Outcome outcome =
        run({"-c", "\"$0\" derive hilbert -n 10 > /dev/null", SIKKU_PROGRAM}, {.program = "bash"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.errors, "");
}

TEST(Program, WarningsAreToldUnlessQuiet) {
    const std::string text = "axiom: F // F\n";
    EXPECT_TRUE(has(run({"derive", "-"}, {.input = text}).errors, "-:1:10: warning: "));
    EXPECT_EQ(run({"derive", "-", "--quiet"}, {.input = text}).errors, "");
    EXPECT_EQ(run({"-q", "derive", "-"}, {.input = text}).errors, "");
    EXPECT_EQ(run({"check", "-"}, {.input = text}).status, 0) << "a warning is no mistake";
    const ScratchFolder folder;
    const Outcome cut = run({"draw", "hilbert", "--step", "5cm", "-o", folder.file("a.svg")});
    EXPECT_EQ(cut.status, 0);
    EXPECT_TRUE(has(cut.errors, "warning: the drawing is"));
    const std::string large = folder.write("large.lsys", "axiom: F\n// " + std::string(70'000, 'x') + "\n");
    for (const char* name : {"a.jpg", "a.tif", "a.png", "a.pdf"}) {
        const bool has_pixels = name != std::string("a.pdf");
        std::vector<std::string> command = {"draw", large, "-o", folder.file(name)};
        if (has_pixels) command.insert(command.end(), {"--dpi", "10"});
        const Outcome kept = run(command);
        EXPECT_EQ(kept.status, 0) << kept.errors;
        const bool is_kept = name == std::string("a.png") || !has_pixels;
        EXPECT_EQ(kept.errors.find("warning: ") == std::string::npos, is_kept) << kept.errors;
        command.insert(command.begin(), "-q");
        EXPECT_EQ(run(command).errors, "");
    }
}

// --- completion ---------------------------------------------------------------------------------------------------

std::set<std::string> completed(const std::vector<std::string>& words) {
    std::string line = "source <(\"$0\" completion bash); COMP_WORDS=(";
    for (const std::string& word : words) line += "'" + word + "' ";
    line += "); COMP_CWORD=" + std::to_string(words.size() - 1) + "; _sikku; printf '%s\\n' \"${COMPREPLY[@]}\"";
    const std::string bin = std::filesystem::path(SIKKU_PROGRAM).parent_path().string();
    const ScratchFolder folder;
    folder.write("snake-file.lsys", "axiom: F");
    folder.write("blank snake.lsys", "axiom: F");
    folder.write("*", "");
    folder.write("$(touch run)", "");
    const Outcome outcome =
        run({"-c", line, SIKKU_PROGRAM},
            {.folder = folder.path(), .environment = {{"PATH", bin + ":" + getenv("PATH")}}, .program = "bash"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.errors, "");
    EXPECT_FALSE(std::filesystem::exists(folder / "run"));
    std::set<std::string> found;
    std::string word;
    for (const char byte : outcome.output) {
        if (byte != '\n') {
            word += byte;
            continue;
        }
        if (!word.empty()) found.insert(word);
        word.clear();
    }
    return found;
}

TEST(Program, CompletionLoadsAndCompletes) {
    EXPECT_EQ(run({"-n"}, {.input = run({"completion", "bash"}).output, .program = "bash"}).status, 0);
    EXPECT_EQ(run({"completion", "zsh"}).output.substr(0, 14), "#compdef sikku");
    const std::string fish = run({"completion", "fish"}).output;
    EXPECT_TRUE(has(fish, "\ncomplete -c sikku -n '__fish_seen_subcommand_from draw' -l size -r -d 'page size: "));
    EXPECT_TRUE(
        has(fish, "\ncomplete -c sikku -n '__fish_seen_subcommand_from draw' -l landscape -d 'landscape page'\n"));
    EXPECT_EQ(completed({"sikku", "d"}), (std::set<std::string>{"derive", "draw"}));
    EXPECT_EQ(completed({"sikku", "draw", "--s"}),
              (std::set<std::string>{"--screen", "--seed", "--set", "--size", "--swatch", "--sway", "--stroke",
                                     "--split", "--spot", "--step", "--steps"}));
    const auto patterns = completed({"sikku", "draw", "snake"});
    EXPECT_TRUE(patterns.contains("snake-kolam"));
    EXPECT_TRUE(patterns.contains("snake-file.lsys"));
    // A name is one word, whatever it consists of.
    EXPECT_EQ(completed({"sikku", "check", "blank"}), (std::set<std::string>{"blank snake.lsys"}));
    EXPECT_EQ(completed({"sikku", "check", "*"}), (std::set<std::string>{"*"}));
    EXPECT_EQ(completed({"sikku", "check", "$"}), (std::set<std::string>{"$(touch run)"}));
}

TEST(Program, DrawsPicturesAndWindowsOfAnyOrder) {
    const ScratchFolder folder;
    const auto drawn = [&](std::vector<std::string> arguments, const std::string& name) {
        arguments.insert(arguments.begin(), {"draw", "hilbert"});
        arguments.insert(arguments.end(), {"-o", folder.file(name)});
        return run(arguments);
    };
    const std::vector<std::string> large = {"-n", "60", "--size", "40x40mm", "--dpi", "150"};
    for (const char* threads : {"1", "2"}) {
        std::vector<std::string> arguments = large;
        arguments.insert(arguments.end(), {"-j", threads});
        const Outcome outcome = drawn(arguments, std::string(threads) + ".png");
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
    }
    EXPECT_EQ(contents(folder.file("1.png")), contents(folder.file("2.png")));
    const std::string far = "-1152921504606846000,384307168202282325,-1152921504606845990,384307168202282335";
    for (const char* name : {"w.svg", "w.pdf", "w.png"}) {
        const Outcome outcome = drawn({"-n", "60", "--size", "40x40mm", "--window", far}, name);
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
    }
    EXPECT_LT(contents(folder.file("w.svg")).size(), 30'000u);
    const Outcome bad = drawn({"--window", "1,2,3"}, "bad.svg");
    EXPECT_EQ(bad.status, 2);
    EXPECT_TRUE(has(bad.errors, "X0,Y0,X1,Y1"));
    const Outcome spline =
        run({"draw", "snake-kolam", "-n", "30", "--window", "0,0,9,9", "-o", folder.file("spline.svg")});
    EXPECT_EQ(spline.status, 0) << spline.errors;
    EXPECT_LT(contents(folder.file("spline.svg")).size(), 30'000u);
    const Outcome colours = run({"draw", "spiral-tiling", "--window", "0,0,9,9", "-o", folder.file("no.svg")});
    EXPECT_EQ(colours.status, 0) << "several pens are read from the word: " << colours.errors;
}

}  // namespace sikku::cli_test
