// tests/program/hostile_text_test.cpp: a title that imitates commands is harmless in every language that the program
// writes.
#include "art/plotter/gcode.h"
#include "art/prints.h"
#include "engine/base/diagnostic.h"
#include "music/score/score_formats.h"
#include "music/scores.h"
#include "tests/program.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <regex>
#include <sstream>

namespace sikku::hostile_text_test {

const std::string pattern = SIKKU_SOURCE_DIR "/tests/corpus/good/hostile-title.lsys";

class HostileTitle : public ::testing::Test {
protected:
    /// What `draw` or `play` makes of the pattern.
    std::string made(const std::string& command, const std::string& name) {
        const std::string format = name.substr(name.find('.') + 1);
        return made_work(command == "draw" ? prints() : scores(), load(pattern), format).outputs.at("x." + format);
    }
    /// Nothing that a terminal obeys, and nothing that changes the order of what it shows.
    static void expect_for_terminals(const std::string& text) {
        for (const char byte : text) {
            const auto code = static_cast<unsigned char>(byte);
            ASSERT_TRUE((code >= 0x20 && code != 0x7F) || byte == '\n' || byte == '\t') << static_cast<int>(code);
        }
        for (const char* mark : {"\u009B", "\u0085", "\u202E", "\u202C", "\u2066", "\u2069"}) {
            EXPECT_EQ(count_of(text, mark), 0u) << mark;
        }
    }

    ScratchFolder folder_;
};

TEST_F(HostileTitle, InGcodeIsAnInactiveComment) {
    std::istringstream lines(made("draw", "x.gcode"));
    const std::regex comment("\\((title|pen [0-9]+): [^()!?~%;]*\\)");
    const std::regex command("([GMTXYZFSPIJ][0-9.-]+ ?)+");
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_TRUE(line.starts_with("(title: /titlescript") || line.starts_with("(title: </title>")) << line;
    int comments = 0;
    do {
        ASSERT_LT(line.size(), 80u) << line;
        for (const char byte : line) ASSERT_TRUE(byte >= 0x20 && byte < 0x7f) << line;
        static const std::regex recipe("\\(recipe: sikku:[A-Za-z0-9+/=]+\\)");
        if (std::regex_match(line, recipe)) continue;
        const bool is_comment = std::regex_match(line, comment);
        comments += is_comment ? 1 : 0;
        ASSERT_TRUE(is_comment || std::regex_match(line, command)) << line;
    } while (std::getline(lines, line));
    EXPECT_GE(comments, 2);
    EXPECT_EQ(gcode_comment("title", "MSG,a!b?c~d%e(f)g;h\x18i\x1bj\u00e9k\n"), "(title: MSG,abcdefghij_k)");
    EXPECT_EQ(gcode_comment("title", std::string(100, 'a')), "(title: " + std::string(60, 'a') + ")");
}

TEST_F(HostileTitle, InHpglIsNowhere) {
    // The pattern's text is written only in base64, in the recipe at the end.
    const std::string plot = made("draw", "x.hpgl");
    const std::size_t end = plot.find("CO\"sikku:");
    ASSERT_NE(end, std::string::npos);
    EXPECT_EQ(plot.substr(0, end).find_first_not_of("INSPUD0123456789,-;\n"), std::string::npos);
    EXPECT_EQ(plot.substr(end).find_first_of("<>'()!?~%"), std::string::npos);
}

TEST_F(HostileTitle, InLilyPondIsOneString) {
    const std::string score = made("play", "x.ly");
    for (const char* mark : {"\u2028", "\u2029", "\u202E", "\u2066", "\u0085", "\u009B", "\x1b", "\x07"}) {
        EXPECT_EQ(count_of(score, mark), 0u);
    }
    std::istringstream lines(score);
    bool has_title = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('%')) {
            EXPECT_FALSE(line.starts_with("%{")) << "it would begin a comment of several lines";
            continue;
        }
        // Outside of strings, # begins Scheme and % a comment.
        std::string code;
        bool in_text = false;
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (in_text && line[i] == '\\') {
                ++i;
            } else if (line[i] == '"') {
                in_text = !in_text;
            } else if (!in_text) {
                code += line[i];
            }
        }
        EXPECT_FALSE(in_text) << line;
        EXPECT_EQ(count_of(code, "#("), line.starts_with("#(set-global-staff-size ") ? 1u : 0u) << line;
        EXPECT_EQ(count_of(code, "system"), line.find("system-system") == std::string::npos ? 0u : 2u) << line;
        static const std::regex title(R"(  title = (\\markup \\center-column \{ *\\vspace #0\.2 \})?)");
        has_title = has_title || std::regex_match(code, title);
    }
    EXPECT_TRUE(has_title);
    EXPECT_EQ(lilypond_string("a\"b\\c#(d)\u2028\u2029\u202Ee\nf"), "\"a\\\"b\\\\c#(d)  ?e f\"");
}

TEST_F(HostileTitle, InAbcIsAField) {
    std::istringstream lines(made("play", "x.abc"));
    // A % that is not escaped begins a comment, and %% at the beginning of a line a directive.
    const std::regex expected("%abc-2.1|% .*|%|%%(score|MIDI) .*|[XTSMLQKV]:([^%]|\\\\%)*|[^%:\"]*|\\[K:.*");
    int titles = 0;
    for (std::string line; std::getline(lines, line);) {
        EXPECT_TRUE(std::regex_match(line, expected)) << line;
        titles += line.starts_with("T:") ? 1 : 0;
    }
    EXPECT_EQ(titles, 1);
}

TEST_F(HostileTitle, InCsoundIsAComment) {
    const std::regex statement("(;.*|t [0-9. ]+|i [0-9. ]+|f 0 [0-9.]+|e|)");
    const std::string score = made("play", "x.sco");
    std::istringstream lines(score);
    for (std::string line; std::getline(lines, line);) EXPECT_TRUE(std::regex_match(line, statement)) << line;
    const std::string file = made("play", "x.csd");
    const std::size_t end = file.find("</CsoundSynthesizer>\n");
    EXPECT_EQ(file.substr(0, end).find_first_of("#$\"'%"), std::string::npos);
    std::istringstream rest(file.substr(end + 21));
    for (std::string line; std::getline(rest, line);) EXPECT_TRUE(line.empty() || line.starts_with(';')) << line;
}

TEST_F(HostileTitle, InStrudelIsAComment) {
    std::istringstream lines(made("play", "x.strudel"));
    const std::regex code(
        "setcpm\\(.*|(\\$: note\\(`)?[a-g#0-9@~ ]*(`\\))?|  \\.slow\\([0-9]+\\)\\.sound\\(\"piano\"\\)");
    for (std::string line; std::getline(lines, line);) {
        EXPECT_TRUE(line.starts_with("//") || std::regex_match(line, code)) << line;
    }
}

TEST_F(HostileTitle, InXmlIsText) {
    for (const auto& [command, name] : {std::pair("draw", "x.svg"), {"play", "x.musicxml"}, {"play", "y.svg"}}) {
        SCOPED_TRACE(name);
        const std::string text = made(command, name);
        pugi::xml_document document;
        const auto parsed = document.load_buffer(text.data(), text.size());
        EXPECT_TRUE(parsed) << parsed.description();
        EXPECT_EQ(count_of(text, "<script>alert"), 0u);
        EXPECT_EQ(count_of(text, "<svg onload"), 0u);
        EXPECT_TRUE(document.select_nodes("//*[@onload]").empty());
    }
}

TEST_F(HostileTitle, InPagesIsText) {
    const std::string page = made("play", "x.html");
    EXPECT_EQ(count_of(page, "<script>alert"), 0u);
    EXPECT_EQ(count_of(page, "<svg onload"), 0u);
    EXPECT_EQ(count_of(page, "<script"), count_of(page, "</script>"));
    const Outcome gallery = run({"gallery", pattern, "-f", "svg,mid", "-o", "out"}, {.folder = folder_.path()});
    EXPECT_EQ(gallery.status, 0) << gallery.errors;
    const std::string index = contents(folder_ / "out/index.html");
    EXPECT_EQ(count_of(index, "<script>alert"), 0u);
    EXPECT_EQ(count_of(index, "<script"), count_of(index, "</script>"));
}

TEST_F(HostileTitle, InMidiAndModelsIsAText) {
    EXPECT_EQ(run({"check", folder_.write("x.mid", made("play", "x.mid"))}).status, 0);
    std::istringstream lines(made("draw", "x.obj"));
    for (std::string line; std::getline(lines, line);) {
        EXPECT_TRUE(std::regex_match(line.substr(0, 7), std::regex("(#|mtllib|o|usemtl|v|vn|f) .*"))) << line;
    }
}

TEST_F(HostileTitle, ReachesNoTerminal) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"measure", pattern},
                                               {"kolam", pattern},
                                               {"play", pattern},
                                               {"gallery", pattern, "--dry-run"},
                                               {"draw", pattern, "--set", "\x1b[31m=\u202E1", "-o", "x.svg"},
                                               {"draw", "\x1b[31m\u009B\u202E.lsys", "-o", "x.svg"}}) {
        SCOPED_TRACE(arguments[0] + " " + arguments.back());
        const Outcome outcome = run(arguments, {.folder = folder_.path()});
        expect_for_terminals(outcome.output);
        expect_for_terminals(outcome.errors);
    }
    expect_for_terminals(printable("a\x1b[0m\u009B\u0085\u202A\u202E\u2066\u2069\x7f\xff", 1000));
    EXPECT_EQ(printable("\u2067a\u202Db", 1000), "?a?b");
    EXPECT_EQ(printable("שלום \u2065", 1000), "שלום \u2065");
}

TEST_F(HostileTitle, InASlurmScriptIsAWord) {
    // What reaches the script are arguments and the names of folders.
    const std::string folder = "it's $(touch PWNED) `touch PWNED`;\n#SBATCH --exclusive\ntouch PWNED \"&";
    std::filesystem::create_directories(folder_ / folder);
    const Surroundings there{.folder = folder_ / folder, .environment = {{"PATH", "/usr/bin:/bin"}}};
    const Outcome outcome = run({"gallery", "hilbert", "--set", "title=$(touch PWNED)`touch PWNED`' ;touch PWNED",
                                 "--slurm", "2", "-o", "out"},
                                there);
    const std::string script = contents(folder_ / folder / "out.sbatch");
    ASSERT_FALSE(script.empty()) << outcome.errors;
    // Slurm reads options up to the first command: none but its own are there.
    std::istringstream lines(script);
    for (std::string line; std::getline(lines, line) && (line.empty() || line.starts_with('#'));) {
        EXPECT_FALSE(line.starts_with("#SBATCH --exclusive"));
    }
    Surroundings task = there;
    task.program = "/bin/bash";
    task.environment.push_back({"SLURM_ARRAY_TASK_ID", "0"});
    task.environment.push_back({"SLURM_ARRAY_TASK_COUNT", "1"});
    task.environment.push_back({"SLURM_ARRAY_TASK_MIN", "0"});
    task.environment.push_back({"SLURM_ARRAY_TASK_STEP", "1"});
    const Outcome made = run({"out.sbatch"}, task);
    EXPECT_EQ(made.status, 0) << made.errors << script;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
        EXPECT_NE(entry.path().filename(), "PWNED") << entry.path();
    }
}

}  // namespace sikku::hostile_text_test
