// tests/studio/server_test.cpp: the language server with damaged patterns.
#include "engine/check.h"
#include "studio/editor/format.h"
#include "studio/editor/language_server.h"
#include "studio/editor/occurrences.h"
#include "studio/editor/rename.h"
#include "studio/editor/text_edit.h"
#include "tests/checks.h"
#include "tests/files.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace sikku::server_test {

/// A server that is ready, and its answers.
class Talk {
public:
    Talk() {
        ask("initialize", Json::object());
        tell("initialized", Json::object());
    }
    void tell(const std::string& method, const Json& parameters) {
        server_.receive(Json({{"method", method}, {"params", parameters}}).dump());
        while (server_.has_work()) server_.work();
    }
    /// The result, or null for an error.
    Json ask(const std::string& method, const Json& parameters) {
        answered_ = false;
        result_ = nullptr;
        server_.receive(Json({{"id", 1}, {"method", method}, {"params", parameters}}).dump());
        while (server_.has_work()) server_.work();
        EXPECT_TRUE(answered_) << method;
        return result_;
    }
    std::size_t reports = 0;  ///< of errors

private:
    void take(const std::string& message) {
        const Json answer = Json::parse(message);
        if (answer.contains("method")) {
            ++reports;
            return;
        }
        answered_ = true;
        if (answer.contains("result")) result_ = answer["result"];
        // Internal errors are faults of the server.
        if (answer.contains("error")) {
            EXPECT_NE(answer["error"]["code"], -32603) << answer;
        }
    }

    LanguageServer server_{[this](const std::string& message) { take(message); }};
    bool answered_ = false;
    Json result_;
};

/// Applies a random careless change that keeps characters complete.
std::string damaged(std::string text, std::mt19937& random) {
    static const std::vector<std::string> pieces = {"(",
                                                    ")",
                                                    ":",
                                                    "-->",
                                                    "<",
                                                    ">",
                                                    "*",
                                                    "\\\n",
                                                    " \\\n",
                                                    "/*",
                                                    "*/",
                                                    "//",
                                                    "\n",
                                                    "\r",
                                                    "=",
                                                    ",",
                                                    "#",
                                                    "~",
                                                    "@",
                                                    "%",
                                                    "𝄞",
                                                    "α",
                                                    "\u202E",
                                                    "\t",
                                                    "define ",
                                                    "table ",
                                                    "n-2",
                                                    "-1",
                                                    "1e9",
                                                    "n",
                                                    "axiom: ",
                                                    "patch x:",
                                                    "interpret:",
                                                    "variant v: ",
                                                    "schedule: ",
                                                    "symbols: ab abc ",
                                                    "surface: a = b.s"};
    const auto place = [&] {
        std::size_t at = std::uniform_int_distribution<std::size_t>(0, text.size())(random);
        while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
        return at;
    };
    for (int change = 0; change < 4; ++change) {
        std::size_t begin = place(), end = place();
        if (begin > end) std::swap(begin, end);
        if (end - begin > 40) end = begin;
        const std::string cut = text.substr(begin, end - begin);
        text.replace(begin, cut.size(), pieces[random() % pieces.size()]);
        if (random() % 3 == 0) text.insert(place(), cut);
    }
    return text;
}

TEST(EditorServer, AnswersAboutDamagedPatterns) {
    Talk talk;
    std::mt19937 random(3);
    const Json document = {{"uri", "file:///none/x.lsys"}};
    const Json at_document = {{"textDocument", document}};
    Json item = document;
    item["text"] = "axiom: F\n";
    talk.tell("textDocument/didOpen", {{"textDocument", item}});
    std::size_t asked = 0;
    for (const auto& file : pattern_files("patterns")) {
        const std::string text = damaged(contents(file), random);
        if (text.size() > 20'000) continue;  // the library of kolams
        talk.tell("textDocument/didChange",
                  {{"textDocument", document}, {"contentChanges", Json::array({{{"text", text}}})}});
        for (const char* method : {"codeLens", "documentColor", "semanticTokens/full", "formatting"}) {
            talk.ask(std::string("textDocument/") + method, at_document);
        }
        for (int place = 0; place < 3; ++place) {
            Json parameters = at_document;
            parameters["position"] = {{"line", random() % 20}, {"character", random() % 40}};
            parameters["newName"] = std::array{"Q", "size", "", "𝄞", "a b"}[random() % 5];
            for (const char* method : {"hover", "completion", "definition", "prepareRename", "rename"}) {
                talk.ask(std::string("textDocument/") + method, parameters);
                ++asked;
            }
        }
    }
    EXPECT_GT(asked, 2500u);
    EXPECT_GT(talk.reports, 200u);
}

/// The meaning of a text with errors is its errors.
std::vector<std::string> errors_of(const std::string& text) {
    Diagnostics diagnostics;
    const Document document = Document::compile("x.lsys", text, {}, diagnostics);
    std::vector<std::string> list;
    for (const Diagnostic& one : diagnostics.sorted()) {
        if (!one.warning) list.push_back(std::to_string(one.where.line) + one.message);
    }
    return list;
}

TEST(EditorServer, FormatsDamagedPatternsWithoutChangingTheirErrors) {
    std::mt19937 random(4);
    std::size_t changed = 0;
    for (int round = 0; round < 4; ++round) {
        for (const auto& file : pattern_files("patterns")) {
            const std::string text = damaged(contents(file), random);
            Diagnostics diagnostics;
            const Pattern pattern = parse_pattern("x.lsys", text, diagnostics);
            if (diagnostics.is_unreadable() || text.size() > 20'000) continue;
            const std::vector<TextEdit> edits = formatting(pattern);
            for (std::size_t i = 1; i < edits.size(); ++i) ASSERT_LE(edits[i - 1].end, edits[i].begin);
            const std::string formatted = with_edits(text, edits);
            EXPECT_EQ(errors_of(formatted), errors_of(text)) << text;
            Diagnostics ignored;
            EXPECT_EQ(with_edits(formatted, formatting(parse_pattern("x.lsys", formatted, ignored))), formatted);
            changed += formatted == text ? 0 : 1;
            std::size_t last = 0;
            for (const Occurrence& each : occurrences(pattern)) {
                ASSERT_GE(each.where.at, last) << text;
                last = each.where.at + each.where.length;
                ASSERT_LE(last, text.size());
            }
        }
    }
    EXPECT_GT(changed, 100u);
}

}  // namespace sikku::server_test
