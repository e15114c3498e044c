// tests/studio/editor_test.cpp: help, formatting and renaming in the text of patterns.
#include "art/prints.h"
#include "engine/base/text.h"
#include "engine/check.h"
#include "engine/derivation/word_printer.h"
#include "engine/map/map_step.h"
#include "music/scores.h"
#include "studio/editor/format.h"
#include "studio/editor/help.h"
#include "studio/editor/highlighting.h"
#include "studio/editor/measures.h"
#include "studio/editor/message_reader.h"
#include "studio/editor/occurrences.h"
#include "studio/editor/rename.h"
#include "studio/editor/text_edit.h"
#include "tests/checks.h"
#include "tests/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace sikku::editor_test {

Pattern pattern_of(const std::string& text) {
    Diagnostics diagnostics;
    return parse_pattern("test.lsys", text, diagnostics);
}

std::string formatted(const std::string& text) {
    return with_edits(text, formatting(pattern_of(text)));
}

/// The beginning of the word of a few steps, or the whole map.
std::string derived(const Document& document) {
    constexpr std::size_t most = 20'000;
    struct Enough {};
    std::string text;
    const auto append = [&](std::string_view part) {
        text += part;
        if (text.size() > most) throw Enough();
    };
    try {
        if (document.map()) {
            print_map(derive_map(document.grammar(), {1e5}), *document.map(), append);
        } else {
            WordPrinter printer(document.grammar(), append);
            derive(document.grammar(), printer, DerivationOptions::within(3e5, [](std::uint64_t) {}));
        }
    } catch (const Enough&) {
        text.resize(most);
    } catch (const BudgetError&) {  // what was printed until then
    }
    return text;
}

Document shortened(const std::filesystem::path& file, const std::string& text) {
    const Document document = parse(file.string(), text);
    const auto steps = document.grammar().steps();
    if (steps <= 4) return document;
    try {
        return document.with({{"derivation length", "4"}});
    } catch (const PatternError&) {  // a schedule needs its steps
        return document;
    }
}

/// Everything that the compiled pattern contains, as text.
std::string described(const std::filesystem::path& file, const std::string& text) {
    const Document document = shortened(file, text);
    std::string result = std::to_string(document.grammar().steps()) + ' ' + std::to_string(document.grammar().seed());
    for (const Key& key : document.pattern().keys) result += '\n' + key.name + '=' + std::string(key.value.view());
    for (const SymbolInfo& symbol : document.grammar().symbols()) {
        result += '\n' + symbol.letter + ' ' + std::to_string(static_cast<int>(symbol.command.action)) + ' ' +
                  std::to_string(symbol.command.value) + ' ' + std::to_string(symbol.arity);
    }
    for (const Table& table : document.grammar().tables()) {
        result += "\ntable";
        for (const Production& production : table.productions()) {
            for (const Word* word :
                 {&production.left, &production.predecessor, &production.right, &production.successor}) {
                result += '\n';
                for (const Symbol symbol : *word) result += ' ' + std::to_string(symbol);
            }
            result += production.condition ? " condition" : "";
            result += production.weight ? " weight" : "";
        }
    }
    return result + '\n' + derived(document);
}

TEST(EditorFormat, SpacesLines) {
    const std::array<std::array<std::string, 2>, 16> cases = {{
        {"axiom:F\n", "axiom: F\n"},
        {"axiom :   F  \nturn : left", "axiom: F\nturn: left\n"},
        {"axiom: F\nF-->F+F\n", "axiom: F\nF --> F+F\n"},
        {"axiom: A(1)\nA(x):x>3-->A(x):2\nA(x) : x<=3  -->  A(x)  :  1\n",
         "axiom: A(1)\nA(x) : x>3 --> A(x) : 2\nA(x) : x<=3 --> A(x) : 1\n"},
        {"axiom: AB\nA<B>C-->D\n", "axiom: AB\nA < B > C --> D\n"},
        {"axiom: F\nF-->\n", "axiom: F\nF-->\n"},
        {"axiom: F\ndefine a=3\ndefine b   =   a*2\n#define c 4\n",
         "axiom: F\ndefine a = 3\ndefine b = a*2\n#define c 4\n"},
        {"axiom: F\ntable a :\nF-->G\n", "axiom: F\ntable a:\nF --> G\n"},
        {"axiom: F\nvariant x :derivation length=3,angle factor=4\n",
         "axiom: F\nvariant x: derivation length = 3, angle factor = 4\n"},
        {"// comment:x  \naxiom:F /* a : b */\n", "// comment:x\naxiom: F /* a : b */\n"},
        {"axiom: F\nF /* here */ --> G\n", "axiom: F\nF /* here */ --> G\n"},
        {"axiom:F \\\n    +F\nF-->G\n", "axiom: F \\\n    +F\nF --> G\n"},
        {"axiom: F\nF --> F \\ \n", "axiom: F\nF --> F \\ \n"},  // without its last blank, the line would continue
        {"axiom: F\nF --> F \\", "axiom: F\nF --> F \\"},
        {"axiom:F\r\nF-->G  \r\n", "axiom: F\r\nF --> G\r\n"},
        {"\n\n  axiom:F\n\n\n", "\n\n  axiom: F\n\n\n"},
    }};
    for (const auto& [text, expected] : cases) EXPECT_EQ(formatted(text), expected);
}

TEST(EditorFormat, LeavesLinesWithErrorsAndUnreadableTextsAlone) {
    EXPECT_EQ(formatted("axiom:F\nF-->G-->H  \n"), "axiom: F\nF-->G-->H\n");
    EXPECT_EQ(formatted("axiom:F /* no end"), "axiom:F /* no end");
    EXPECT_EQ(formatted(""), "");
}

TEST(EditorFormat, LeavesBundledPatternsAsTheyAre) {
    for (const auto& file : pattern_files("patterns")) EXPECT_EQ(formatted(contents(file)), contents(file)) << file;
}

/// Patterns whose spacing is as bad as it can be without another meaning.
TEST(EditorFormat, KeepsTheMeaningOfSqueezedPatterns) {
    static const std::regex arrow(R"( *--> *)"), colon(R"(^([a-z ]+): )", std::regex::multiline);
    int compared = 0;
    for (const auto& file : pattern_files("patterns")) {
        const std::string text = contents(file);
        const std::string squeezed = std::regex_replace(std::regex_replace(text, arrow, "-->"), colon, "$1 :\t");
        Diagnostics diagnostics;
        Document::compile(file.string(), squeezed, {}, diagnostics);
        if (diagnostics.has_errors()) continue;
        const std::string again = formatted(squeezed);
        EXPECT_EQ(formatted(again), again) << file;
        EXPECT_EQ(described(file, again), described(file, squeezed)) << file;
        ++compared;
    }
    EXPECT_GT(compared, 150);
}

TEST(EditorNames, ArrowsAreThoseOfTheLines) {
    for (const auto& file : pattern_files("patterns")) {
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern(file.string(), contents(file), diagnostics);
        // A second reader: lines that contain an arrow, in the text without comments.
        std::vector<std::size_t> arrows;
        const std::string_view text = pattern.source->cleaned();
        for (std::size_t at = text.find("-->"); at != std::string_view::npos; at = text.find("-->", at + 1)) {
            const std::size_t line = text.rfind('\n', at) + 1;
            const bool is_text =
                text.substr(line).starts_with("description:") || text.substr(line).starts_with("source:");
            if (!is_text) arrows.push_back(at);
        }
        std::vector<std::size_t> found;
        std::size_t keys = 0;
        for (const Occurrence& each : occurrences(pattern)) {
            EXPECT_FALSE(each.where.empty());
            if (each.kind == NameKind::arrow) found.push_back(each.where.at);
            if (each.kind == NameKind::key) ++keys;
        }
        EXPECT_EQ(found, arrows) << file;
        EXPECT_GE(keys, pattern.keys.size()) << file;
    }
}

const std::string sample =
    "derivation length: 2\nangle increment: 60\ndefine k = 2\ndefine m = k + 1\nsymbols: bud\n"
    "axiom: A(k) bud ~leaf\ntable one:\nA(x) : x > k --> F(x)[+A(x-1)]\ntable two:\nbud --> bud F\n"
    "A(k) --> F(k)\nschedule: one*(n-k) two*1\nvariant v: k = 3\npatch leaf:\n0 0 0  1 0 0  2 0 0  3 0 0\n";

/// Occurrences of the name at the first place of `text` in the sample, as `line:column` from 1.
std::vector<std::string> places_of(const std::string& text, std::size_t skip = 0) {
    const Pattern pattern = pattern_of(sample);
    const auto all = occurrences(pattern);
    const Occurrence* name = find_occurrence(all, sample.find(text) + skip);
    std::vector<std::string> places;
    for (const Occurrence& each : all) {
        if (!name || !each.is_same(*name)) continue;
        const Place place = pattern.source->place(each.where.at);
        places.push_back(std::to_string(place.line) + ':' + std::to_string(place.column) +
                         (each.is_definition ? "!" : ""));
    }
    return places;
}

TEST(EditorNames, AreFoundWhereTheyStand) {
    using Places = std::vector<std::string>;
    EXPECT_EQ(places_of("k = 2"), (Places{"3:8!", "4:12", "6:10", "8:12", "12:18", "13:12"}));
    EXPECT_EQ(places_of("A(k) --> F(k)", 2), (Places{"11:3!", "11:12"})) << "a parameter hides the define";
    EXPECT_EQ(places_of("x > k"), (Places{"8:3!", "8:8", "8:20", "8:26"}));
    EXPECT_EQ(places_of("one:"), (Places{"7:7!", "12:11"}));
    EXPECT_EQ(places_of("two*1"), (Places{"9:7!", "12:21"}));
    EXPECT_EQ(places_of("bud\n"), (Places{"5:10!", "6:13", "10:1!", "10:9"}));
    EXPECT_EQ(places_of("~leaf", 1), (Places{"6:18", "14:7!"}));
    EXPECT_EQ(places_of("angle"), (Places{"2:1"}));
    EXPECT_EQ(places_of("[+A", 1), (Places{"8:23"}));
}

std::string renamed(const std::string& text, const std::string& old_name, const std::string& new_name,
                    std::size_t from = 0) {
    const Pattern pattern = pattern_of(text);
    const auto all = occurrences(pattern);
    const Occurrence* name = find_occurrence(all, text.find(old_name, from));
    if (!name) return "no name";
    try {
        return with_edits(text, renaming(pattern, all, *name, new_name));
    } catch (const RenameError& error) {
        return error.what();
    }
}

TEST(EditorRename, RenamesEveryPlaceAndRefusesOtherMeanings) {
    const std::string curve = "axiom: X\nX --> +YF\nY --> XF\nmove: f\n";
    EXPECT_EQ(renamed(curve, "X", "Z"), "axiom: Z\nZ --> +YF\nY --> ZF\nmove: f\n");
    EXPECT_TRUE(has(renamed(curve, "X", "Y"), "already in use"));
    EXPECT_TRUE(has(renamed(curve, "X", "G\nG"), "not a valid name"));
    EXPECT_TRUE(has(renamed(curve, "X", ""), "not a valid name"));
    EXPECT_TRUE(has(renamed(curve, "X", "("), "not a valid name"));
    EXPECT_TRUE(has(renamed(curve, "X", "bud"), "not a valid name"));
    EXPECT_TRUE(has(renamed(curve, "X", "-"), "would change"));
    EXPECT_TRUE(has(renamed(curve, "X", "%"), "not a valid name"));
    EXPECT_TRUE(has(renamed(curve, "F", "H"), "would change"));
    EXPECT_TRUE(has(renamed(curve, "axiom", "H"), "a key cannot be renamed"));
    EXPECT_TRUE(has(renamed("axiom: X\nX --> (\n", "X", "Z"), "the pattern has errors: line 2"));
    EXPECT_TRUE(has(renamed("axiom: A\nnamed notes: yes\nmapping: symbols\n", "A", "B"), "named notes"));
    EXPECT_EQ(renamed("axiom: X\nforward: X\nX --> XX\n", "X", "Z"), "axiom: Z\nforward: Z\nZ --> ZZ\n");
    EXPECT_EQ(renamed("axiom: X\nnote X: C4\n", "X", "Z"), "axiom: Z\nnote Z: C4\n");
    EXPECT_EQ(renamed("define a = 1\ndefine b = a\naxiom: F(b)\n", "a", "size", 7),
              "define size = 1\ndefine b = size\naxiom: F(b)\n");
    // The parameter would hide the define.
    const std::string hidden = "define a = 1\naxiom: A(1)\nA(x) --> A(a)\n";
    EXPECT_TRUE(has(renamed(hidden, "x", "a", hidden.find("A(x")), "another meaning"));
    EXPECT_TRUE(has(renamed(hidden, "a", "x", 7), "another meaning"));
    EXPECT_TRUE(has(renamed("define a = 1\naxiom: F(a)\n", "a", "3", 7), "not a valid name"));
    const std::string tables =
        "axiom: A\ntable a:\nA --> B\ntable b:\nB --> A\nschedule: a b\nderivation length: 2\n";
    EXPECT_EQ(renamed(tables, "a:", "grow", 14),
              "axiom: A\ntable grow:\nA --> B\ntable b:\nB --> A\nschedule: grow b\nderivation length: 2\n");
    EXPECT_TRUE(has(renamed(tables, "a:", "x y", 14), "not a valid name"));
}

/// A second algorithm: the word of the renamed pattern is the old one with the letter exchanged.
TEST(EditorRename, ExchangesLettersOfEveryWord) {
    int compared = 0;
    for (const auto& file : pattern_files("patterns")) {
        const std::string text = contents(file);
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern(file.string(), text, diagnostics);
        const Document before = shortened(file, text);
        if (before.map() || before.pattern().find("symbols")) continue;
        const auto all = occurrences(pattern);
        const auto found = std::find_if(all.begin(), all.end(), [&](const Occurrence& each) {
            const std::string_view name = each.where.view();
            const auto& symbols = before.grammar().symbols();
            return each.kind == NameKind::symbol && each.is_definition && name.size() == 1 &&
                   std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
                   std::all_of(symbols.begin(), symbols.end(), [&](const SymbolInfo& symbol) {
                       return symbol.letter != name || symbol.command.action == Action::pass;
                   });
        });
        const bool has_letter = has(derived(before), "Q");
        if (found == all.end() || has_letter) continue;
        std::string after;
        try {
            after = with_edits(text, renaming(pattern, all, *found, "Q"));
        } catch (const RenameError& error) {
            EXPECT_TRUE(has(error.what(), "already in use") || has(error.what(), "named notes"))
                << file << error.what();
            continue;
        }
        std::string word = derived(before);
        std::replace(word.begin(), word.end(), found->where.view()[0], 'Q');
        EXPECT_EQ(derived(shortened(file, after)), word) << file;
        ++compared;
    }
    EXPECT_GT(compared, 60);
}

TEST(EditorHelp, ChoicesAreValues) {
    const std::array<const Interpreter*, 2> both = {&prints(), &scores()};
    std::size_t checked = 0;
    for (const KeyInfo& key : language_keys()) {
        const auto choices = choices_of(key);
        if (key.is_for_symbols() || choices.size() > 100) continue;
        for (const std::string& choice : choices) {
            std::string text =
                "axiom: F+F\nderivation length: 2\nF --> F+F\n" + std::string(key.name) + ": " + choice + "\n";
            if (key.scope == KeyScope::maps || choice == "sides") {
                text = (key.name == "map" ? "" : "map: clockwise\n") + std::string("axiom: FF\nF --> FF\n") +
                       std::string(key.name) + ": " + choice + "\n";
            }
            for (const Diagnostic& one : check_pattern("test.lsys", text, both, {})) {
                EXPECT_TRUE(one.warning || !has(one.message, "expected") || has(one.message, "'progression"))
                    << one.text();
            }
            ++checked;
        }
    }
    EXPECT_GT(checked, 100u);
}

std::vector<std::string> completed(const std::string& text) {
    std::vector<std::string> labels;
    for (const Completion& each : complete(pattern_of(text), text.size()).items) labels.push_back(each.label);
    return labels;
}

TEST(EditorHelp, Completes) {
    using Labels = std::vector<std::string>;
    EXPECT_EQ(completed("axiom: F\nturn: "), (Labels{"right", "left"}));
    EXPECT_EQ(completed("axiom: F\nTurn : le"), (Labels{"right", "left"}));
    EXPECT_EQ(completed("axiom: F\ntable a:\nF --> G\ntable b:\nG --> F\nschedule: a*2 "), (Labels{"a", "b"}));
    EXPECT_EQ(completed("axiom: F\ntitle: "), Labels());
    EXPECT_EQ(completed("axiom: F\nF --> "), Labels());
    EXPECT_EQ(completed("axiom: F\nno such key: "), Labels());
    const Labels keys = completed("axiom: F\nang");
    EXPECT_EQ(std::count(keys.begin(), keys.end(), "angle factor"), 1);
    EXPECT_EQ(std::count(keys.begin(), keys.end(), "axiom"), 0) << "it is set";
    EXPECT_GT(completed("axiom: F\nscale: ").size(), 200u);
    EXPECT_EQ(completed("axiom: F\ninstrument: ").size(), 128u);
}

TEST(EditorHelp, DescribesNames) {
    const auto help = [](const std::string& text, std::size_t skip = 0) {
        const Pattern pattern = pattern_of(sample);
        const auto all = occurrences(pattern);
        const Occurrence* name = find_occurrence(all, sample.find(text) + skip);
        return name ? help_for(*name, pattern, all) : "none";
    };
    EXPECT_TRUE(has(help("angle increment"), "Angle by which `+` and `-` turn"));
    EXPECT_TRUE(has(help("k = 2"), "`k = 2`"));
    EXPECT_TRUE(has(help("A(k) bud"), "`A(x) : x > k --> F(x)[+A(x-1)]` (line 8)"));
    EXPECT_TRUE(has(help("[+A"), "Save the turtle's state"));
    EXPECT_TRUE(has(help("one*"), "1 production"));
    EXPECT_EQ(help("-->"), "");
}

TEST(EditorHelp, SizesAreThoseOfTheLiterature) {
    // The Koch curve has 4^n segments, and is 3^n wide.
    const Document koch =
        parse("koch", "axiom: F\nangle factor: 6\nheading: 0\nderivation length: 5\nF --> F-F++F-F\n");
    EXPECT_TRUE(has(measures_text(koch), "1024 segments, 243 x ")) << measures_text(koch);
    const std::string table = growth_table(koch, {});
    EXPECT_TRUE(has(table, "| 5 (set) |") && has(table, "| 0 | 1 symbol, 1 segment, 1 x 0 steps |")) << table;
    EXPECT_TRUE(has(table, "| 6 | ") && has(table, "4096 segments, 729 x ")) << table;
    const Document map =
        parse("map", "map: clockwise\naxiom: A~B~AB\nderivation length: 3\nA --> B[-A][+~A]B\nB --> ~A\n");
    EXPECT_TRUE(has(measures_text(map), "8 cells")) << measures_text(map);
}

TEST(EditorPositions, CountUtf16) {
    // α takes 2 bytes and 1 unit, 𝄞 4 bytes and 2 units.
    const std::string text = "aα𝄞b\r\nc\rd\n";
    const TextPositions positions(text);
    EXPECT_EQ(positions.offset(EditorPosition{0, 0}), 0u);
    EXPECT_EQ(positions.offset(EditorPosition{0, 1}), 1u);
    EXPECT_EQ(positions.offset(EditorPosition{0, 2}), 3u);
    EXPECT_EQ(positions.offset(EditorPosition{0, 3}), 3u) << "within a character";
    EXPECT_EQ(positions.offset(EditorPosition{0, 4}), 7u);
    EXPECT_EQ(positions.offset(EditorPosition{0, 99}), 8u);
    EXPECT_EQ(positions.offset(EditorPosition{1, 0}), 10u);
    EXPECT_EQ(positions.offset(EditorPosition{1, 5}), 11u);
    EXPECT_EQ(positions.offset(EditorPosition{2, 0}), 12u);
    EXPECT_EQ(positions.offset(EditorPosition{3, 0}), 14u);
    EXPECT_EQ(positions.offset(EditorPosition{99, 99}), text.size());
    for (std::size_t at = 0; at <= text.size(); ++at) {
        const EditorPosition position = positions.position(at);
        EXPECT_LE(positions.offset(position), at);
    }
    const EditorPosition last = positions.position(99);
    EXPECT_EQ(last.line, 3u);
    EXPECT_EQ(last.character, 0u);
    EXPECT_EQ(positions.offset(Place{2, 2}), 11u);
    EXPECT_EQ(positions.offset(Place{9, 9}), text.size());
}

TEST(EditorMessages, ArriveInAnyPieces) {
    const std::string all = with_header("{}") + "Content-Type: x\r\ncontent-length:  3 \r\n\r\nabc" +
                            "Content-Length: 0\n\n" + with_header(std::string(5000, 'x'));
    for (const std::size_t piece : {1, 2, 7, 100, 100'000}) {
        MessageReader reader;
        std::vector<std::string> messages;
        for (std::size_t at = 0; at < all.size(); at += piece) {
            reader.add(std::string_view(all).substr(at, piece));
            while (const auto message = reader.next()) messages.push_back(message->content);
        }
        EXPECT_EQ(messages, (std::vector<std::string>{"{}", "abc", "", std::string(5000, 'x')})) << piece;
        EXPECT_FALSE(reader.is_broken());
    }
}

TEST(EditorMessages, RefuseHeadersAndSkipWhatIsTooLarge) {
    for (const char* header : {"\r\n\r\n", "Content-Length: x\r\n\r\n", "Content-Length: -1\r\n\r\n", "{}\r\n\r\n",
                               "Content-Length: 99999999999999999999\r\n\r\n", "Content-Type: x\r\n\r\n"}) {
        MessageReader reader;
        reader.add(header);
        EXPECT_FALSE(reader.next());
        EXPECT_TRUE(reader.is_broken()) << header;
    }
    MessageReader endless;
    endless.add(std::string(5000, 'x'));
    EXPECT_FALSE(endless.next());
    EXPECT_TRUE(endless.is_broken());
    MessageReader reader;
    const std::size_t size = MessageReader::most_bytes + 10;
    reader.add("Content-Length: " + std::to_string(size) + "\r\n\r\nabc");
    const std::string block(1U << 20U, 'x');
    for (std::size_t left = size - 3; left > 0; left -= std::min(left, block.size())) {
        EXPECT_FALSE(reader.next());
        reader.add(std::string_view(block).substr(0, std::min(left, block.size())));
    }
    reader.add(with_header("next"));
    const auto skipped = reader.next();
    ASSERT_TRUE(skipped && skipped->is_skipped);
    EXPECT_EQ(skipped->size, size);
    const auto next = reader.next();
    ASSERT_TRUE(next);
    EXPECT_EQ(next->content, "next");
}

/// `sikku lsp --grammar` prints them. SIKKU_WRITE_DOCS=1 writes the files instead.
TEST(EditorGrammars, FilesAreUpToDate) {
    const std::filesystem::path folder = std::filesystem::path(SIKKU_SOURCE_DIR) / "packaging/editors";
    const auto compare = [&](const char* name, const std::string& text) {
        if (std::getenv("SIKKU_WRITE_DOCS")) std::ofstream(folder / name, std::ios::binary) << text;
        EXPECT_EQ(contents(folder / name), text) << "write it again: see CONTRIBUTING.md";
    };
    compare("vscode/syntaxes/sikku.tmLanguage.json", textmate_grammar());
    compare("vim/syntax/sikku.vim", vim_syntax());
}

}  // namespace sikku::editor_test
