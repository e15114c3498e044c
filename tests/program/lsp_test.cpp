// tests/program/lsp_test.cpp: conversations with `sikku lsp`, as editors have them.
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

namespace sikku::lsp_test {

using Json = nlohmann::ordered_json;

std::string message(const std::string& content) {
    return "Content-Length: " + std::to_string(content.size()) + "\r\n\r\n" + content;
}

std::string request(int id, const std::string& method, const Json& parameters = Json::object()) {
    return message(Json({{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", parameters}}).dump());
}

std::string notice(const std::string& method, const Json& parameters = Json::object()) {
    return message(Json({{"jsonrpc", "2.0"}, {"method", method}, {"params", parameters}}).dump());
}

/// The answers of the server, and its exit status.
struct Conversation {
    std::vector<Json> messages;
    Outcome outcome;

    /// The answer to a request; null if there is none.
    Json answer(int id) const {
        const auto found = std::find_if(messages.begin(), messages.end(),
                                        [&](const Json& each) { return each.contains("id") && each["id"] == id; });
        return found == messages.end() ? Json() : *found;
    }
    Json result(int id) const { return answer(id).value("result", Json()); }
    int error(int id) const {
        return answer(id).is_null() ? 0 : answer(id).value("error", Json::object()).value("code", 0);
    }
    std::string reason(int id) const { return answer(id).value("error", Json::object()).value("message", ""); }
    /// The last diagnostics of a document.
    Json diagnostics(const std::string& address) const {
        Json last;
        for (const Json& each : messages) {
            if (each.value("method", "") == "textDocument/publishDiagnostics" && each["params"]["uri"] == address) {
                last = each["params"]["diagnostics"];
            }
        }
        return last;
    }
};

Conversation converse(const std::string& input) {
    Conversation conversation;
    conversation.outcome = run({"lsp"}, {.input = input});
    std::string_view rest = conversation.outcome.output;
    const std::string_view header = "Content-Length: ";
    while (rest.starts_with(header)) {
        const std::size_t size = std::stoul(std::string(rest.substr(header.size(), 20)));
        rest.remove_prefix(rest.find("\r\n\r\n") + 4);
        conversation.messages.push_back(Json::parse(rest.substr(0, size)));
        rest.remove_prefix(size);
    }
    EXPECT_TRUE(rest.empty()) << rest;
    return conversation;
}

const std::string start = request(0, "initialize") + notice("initialized");
const std::string end = request(999, "shutdown", nullptr) + notice("exit");
const std::string address = "file:///tmp/test.lsys";

std::string opened(const std::string& text, const std::string& name = address) {
    return notice("textDocument/didOpen",
                  {{"textDocument", {{"uri", name}, {"languageId", "sikku"}, {"version", 1}, {"text", text}}}});
}
std::string changed(const std::string& text, const std::string& name = address) {
    return notice("textDocument/didChange", {{"textDocument", {{"uri", name}, {"version", 2}}},
                                             {"contentChanges", Json::array({{{"text", text}}})}});
}
Json document(const std::string& name = address) {
    return {{"textDocument", {{"uri", name}}}};
}
Json place(std::uint64_t line, std::uint64_t character) {
    Json parameters = document();
    parameters["position"] = {{"line", line}, {"character", character}};
    return parameters;
}
Json range(int line, int begin, int end_of) {
    return {{"start", {{"line", line}, {"character", begin}}}, {"end", {{"line", line}, {"character", end_of}}}};
}

TEST(Lsp, SaysWhatItServesAndEnds) {
    const Conversation talk = converse(start + end);
    const Json able = talk.result(0)["capabilities"];
    for (const char* provider :
         {"hoverProvider", "completionProvider", "definitionProvider", "renameProvider", "documentFormattingProvider",
          "colorProvider", "codeLensProvider", "semanticTokensProvider"}) {
        EXPECT_TRUE(able.contains(provider)) << provider;
    }
    EXPECT_EQ(able["textDocumentSync"]["change"], 1);
    EXPECT_EQ(talk.result(0)["serverInfo"]["name"], "sikku");
    EXPECT_TRUE(talk.answer(999).contains("result"));
    EXPECT_EQ(talk.outcome.status, 0);
    EXPECT_EQ(talk.outcome.errors, "");
    EXPECT_EQ(converse(start + notice("exit")).outcome.status, 1) << "no shutdown";
    EXPECT_EQ(converse(start).outcome.status, 1) << "the editor vanished";
    EXPECT_EQ(converse(start + request(1, "shutdown")).outcome.status, 0);
    EXPECT_EQ(converse("").outcome.status, 1);
}

TEST(Lsp, ReportsErrorsWhereTheyStand) {
    // 𝄞 takes two units, α one.
    const Conversation talk = converse(start + opened("axiom: α𝄞(F\nangel factor: 4\n") + end);
    const Json list = talk.diagnostics(address);
    ASSERT_EQ(list.size(), 2u) << list;
    EXPECT_EQ(list[0]["range"], range(0, 10, 11));
    EXPECT_EQ(list[0]["severity"], 1);
    EXPECT_EQ(list[0]["source"], "sikku");
    EXPECT_EQ(list[1]["range"], range(1, 0, 5));
    EXPECT_TRUE(has(list[1]["message"].get<std::string>(), "did you mean 'angle factor'"));
}

TEST(Lsp, FollowsChangesAndForgetsClosedDocuments) {
    const std::string close = notice("textDocument/didClose", document());
    EXPECT_EQ(converse(start + opened("axim: F\n") + changed("axiom: F\n") + end).diagnostics(address),
              Json::array());
    EXPECT_EQ(converse(start + opened("axiom: F\n") + changed("axim: F\n") + end).diagnostics(address).size(), 2u);
    const Conversation closed =
        converse(start + opened("axim: F\n") + close + request(1, "textDocument/hover", place(0, 0)) + close + end);
    EXPECT_EQ(closed.diagnostics(address), Json::array());
    EXPECT_EQ(closed.error(1), -32602);
    EXPECT_TRUE(has(closed.reason(1), "not open"));
    EXPECT_EQ(closed.outcome.status, 0);
}

/// The server requests whole texts, but accepts changed parts.
TEST(Lsp, FollowsChangesOfParts) {
    const auto part = [](const Json& where, const char* text) -> Json { return {{"range", where}, {"text", text}}; };
    const auto changes = [](const Json& list) {
        return notice("textDocument/didChange",
                      {{"textDocument", {{"uri", address}, {"version", 2}}}, {"contentChanges", list}});
    };
    const Json end_of = {{"start", {{"line", 99}, {"character", 99}}}, {"end", {{"line", 3}, {"character", 0}}}};
    const Conversation talk =
        converse(start + opened("axiom: 𝄞X\n") +
                 changes({part(range(0, 7, 9), "Y"), part(range(0, 8, 9), ""), part(end_of, "Y --> YF\n")}) +
                 request(1, "textDocument/hover", place(0, 7)) + end);
    EXPECT_EQ(talk.diagnostics(address), Json::array());
    EXPECT_TRUE(has(talk.result(1)["contents"]["value"].get<std::string>(), "`Y --> YF` (line 2)"));
    const Conversation wrong =
        converse(start + changes({part(range(0, 0, 1), "")}) + opened("axiom: X\n") + changes({{{"range", 3}}}) +
                 changes({{{"range", range(0, 0, 1)}}}) + changes(3) + end);
    EXPECT_EQ(wrong.messages.size(), 7u) << "four complaints";
    EXPECT_EQ(wrong.diagnostics(address), Json::array());
    EXPECT_EQ(wrong.outcome.status, 0);
}

TEST(Lsp, CancelsRequestsThatWait) {
    const auto cancel = [](const Json& id) { return notice("$/cancelRequest", {{"id", id}}); };
    const Conversation talk = converse(start + opened("axiom: F\n") + request(1, "textDocument/hover", place(0, 0)) +
                                       request(2, "textDocument/hover", place(0, 0)) + cancel(1) + cancel(77) +
                                       cancel(nullptr) + cancel("1") + notice("$/cancelRequest") + end);
    EXPECT_EQ(talk.error(1), -32800) << talk.answer(1);
    EXPECT_TRUE(talk.answer(2).contains("result"));
    EXPECT_EQ(talk.messages.size(), 5u) << "initialize, 1, errors, 2, shutdown";
    EXPECT_EQ(talk.outcome.status, 0);
}

TEST(Lsp, FindsFilesBesideThePattern) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "my leaves");
    std::filesystem::copy(std::filesystem::path(SIKKU_SOURCE_DIR) / "tests/corpus/surfaces/plain.s",
                          folder / "my leaves" / "leaf.s");
    const std::string name = "file://" + folder.file("my%20leaves/a.lsys");
    const std::string text = "axiom: F~leaf\nsurface: leaf = ";
    EXPECT_EQ(converse(start + opened(text + "leaf.s\n", name) + end).diagnostics(name), Json::array());
    const Json list = converse(start + opened(text + "other.s\n", name) + end).diagnostics(name);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0]["range"], range(1, 16, 21));
}

const std::string curve =
    "derivation length: 3\ndefine k = 2\nstroke: 0.4mm #f80\nground: slate\npalette: red, #00ff0080\naxiom: X(k)\n"
    "table a:\nX(i) --> F[+F]X(i+k)\ntable b:\nF-->FF\nschedule: a*2 b\nvariant v: derivation length = 4, stroke = "
    "1mm blue\n";

TEST(Lsp, AnswersAboutThePlaceInTheText) {
    const Conversation talk = converse(
        start + opened(curve) + request(1, "textDocument/hover", place(0, 3)) +
        request(2, "textDocument/hover", place(5, 7)) + request(3, "textDocument/hover", place(1, 7)) +
        request(4, "textDocument/definition", place(5, 9)) + request(5, "textDocument/definition", place(10, 10)) +
        request(6, "textDocument/definition", place(5, 7)) + request(7, "textDocument/hover", place(3, 9)) + end);
    const auto help = [&](int id) { return talk.result(id)["contents"]["value"].get<std::string>(); };
    EXPECT_TRUE(has(help(1), "Number of derivation steps") && has(help(1), "| 3 (set) | ")) << help(1);
    EXPECT_EQ(talk.result(1)["range"], range(0, 0, 17));
    EXPECT_TRUE(has(help(2), "X(i) --> F[+F]X(i+k)")) << help(2);
    EXPECT_TRUE(has(help(3), "`k = 2`")) << help(3);
    EXPECT_EQ(talk.result(4), Json::array({{{"uri", address}, {"range", range(1, 7, 8)}}}));
    EXPECT_EQ(talk.result(5), Json::array({{{"uri", address}, {"range", range(6, 6, 7)}}}));
    EXPECT_EQ(talk.result(6), Json::array({{{"uri", address}, {"range", range(7, 0, 1)}}}));
    EXPECT_TRUE(talk.answer(7).contains("result") && talk.result(7).is_null());
}

TEST(Lsp, RenamesFormatsAndCompletes) {
    Json renaming = place(1, 7), refused = place(0, 3), taken = place(5, 7);
    renaming["newName"] = "size";
    refused["newName"] = "size";
    taken["newName"] = "F";
    Json form = document();
    form["options"] = {{"tabSize", 4}, {"insertSpaces", true}};
    const Conversation talk =
        converse(start + opened(curve) + request(1, "textDocument/rename", renaming) +
                 request(2, "textDocument/rename", refused) + request(3, "textDocument/rename", taken) +
                 request(4, "textDocument/prepareRename", place(5, 7)) + request(5, "textDocument/formatting", form) +
                 changed("axiom: F\nturn: ") + request(6, "textDocument/completion", place(1, 6)) + end);
    const auto edit = [](const Json& where, const char* text) -> Json {
        return {{"range", where}, {"newText", text}};
    };
    EXPECT_EQ(
        talk.result(1)["changes"][address],
        Json::array({edit(range(1, 7, 8), "size"), edit(range(5, 9, 10), "size"), edit(range(7, 18, 19), "size")}));
    EXPECT_EQ(talk.error(2), -32803);
    EXPECT_TRUE(has(talk.reason(3), "already in use"));
    EXPECT_EQ(talk.result(4)["placeholder"], "X");
    EXPECT_EQ(talk.result(5), Json::array({edit(range(9, 1, 4), " --> ")}));
    const Json items = talk.result(6)["items"];
    ASSERT_EQ(items.size(), 2u);
    EXPECT_EQ(items[1]["label"], "left");
    EXPECT_EQ(items[1]["textEdit"], edit(range(1, 6, 6), "left"));
}

TEST(Lsp, ShowsColoursAndSizes) {
    const Json blue = {{"red", 0}, {"green", 0}, {"blue", 1.0}, {"alpha", 1}};
    const Json pale = {{"red", 2}, {"green", -1}, {"blue", 0.5}, {"alpha", 0.5}};
    const Conversation talk =
        converse(start + opened(curve) + request(1, "textDocument/documentColor", document()) +
                 request(2, "textDocument/colorPresentation", {{"color", blue}, {"range", range(0, 0, 0)}}) +
                 request(3, "textDocument/colorPresentation", {{"color", pale}, {"range", range(0, 0, 0)}}) +
                 request(4, "textDocument/codeLens", document()) +
                 request(5, "textDocument/semanticTokens/full", document()) + end);
    const Json colours = talk.result(1);
    ASSERT_EQ(colours.size(), 4u) << colours;
    EXPECT_EQ(colours[0]["range"], range(2, 14, 18));
    EXPECT_EQ(colours[0]["color"]["green"], 0x88 / 255.0);
    EXPECT_EQ(colours[2]["range"], range(4, 14, 23));
    EXPECT_EQ(colours[2]["color"]["alpha"], 128 / 255.0);
    EXPECT_EQ(colours[3]["range"], range(11, 47, 51));
    EXPECT_EQ(talk.result(2), Json::array({{{"label", "#0000ff"}}, {{"label", "blue"}}}));
    EXPECT_EQ(talk.result(3), Json::array({{{"label", "#ff008080"}}}));
    const Json lenses = talk.result(4);
    ASSERT_EQ(lenses.size(), 1u) << "no longer schedule, and the variant has too few steps: " << lenses;
    EXPECT_EQ(lenses[0]["range"], range(0, 0, 17));
    EXPECT_TRUE(has(lenses[0]["command"]["title"].get<std::string>(), "n = 3: 15 symbols, 8 segments")) << lenses;
    EXPECT_EQ(talk.result(5)["data"].size() % 5, 0u);
}

/// Names of several characters are coloured as a whole; 𝄞 takes two units.
TEST(Lsp, ColoursNames) {
    const Conversation talk = converse(start + opened("symbols: bud\naxiom: 𝄞bud[@O]\nbud --> A\n") +
                                       request(1, "textDocument/semanticTokens/full", document()) + end);
    EXPECT_EQ(talk.result(1)["data"], Json::array({0, 0, 7, 0, 0, 0, 9, 3, 5, 0, 1, 0, 5, 0, 0, 0, 9, 3,
                                                   5, 0, 0, 4, 2, 5, 0, 1, 0, 3, 5, 0, 0, 4, 3, 4, 0}));
}

TEST(Lsp, PositionsMayBeAnywhere) {
    std::string input = start + opened(curve);
    int id = 0;
    for (const std::uint64_t line : {0ULL, 5ULL, 12ULL, 13ULL, 4'000'000'000ULL, 18'446'744'073'709'551'615ULL}) {
        for (const std::uint64_t character : {0ULL, 1000ULL, 18'446'744'073'709'551'615ULL}) {
            for (const char* method : {"textDocument/hover", "textDocument/completion", "textDocument/definition",
                                       "textDocument/prepareRename"}) {
                input += request(++id, method, place(line, character));
            }
        }
    }
    const Conversation talk = converse(input + end);
    EXPECT_EQ(talk.outcome.status, 0);
    for (int each = 1; each <= id; ++each) {
        EXPECT_TRUE(talk.answer(each).contains("result") || talk.error(each) == -32803) << talk.answer(each);
    }
    Json negative = document(), real = document(), text = document();
    negative["position"] = {{"line", -1}, {"character", 0}};
    real["position"] = {{"line", 1.5}, {"character", 0}};
    text["position"] = "here";
    const Conversation wrong = converse(
        start + opened(curve) + request(1, "textDocument/hover", negative) + request(2, "textDocument/hover", real) +
        request(3, "textDocument/hover", text) + request(4, "textDocument/hover", document()) +
        request(5, "textDocument/hover", nullptr) + request(6, "textDocument/rename", place(1, 7)) + end);
    for (int each = 1; each <= 6; ++each) EXPECT_EQ(wrong.error(each), -32602) << wrong.answer(each);
}

TEST(Lsp, RefusesWhatIsOutOfOrder) {
    const Conversation early = converse(request(1, "textDocument/hover", place(0, 0)) + opened("axim: F\n") +
                                        request(2, "shutdown") + start + request(3, "initialize") + end);
    EXPECT_EQ(early.error(1), -32002);
    EXPECT_EQ(early.error(2), -32002);
    EXPECT_TRUE(early.diagnostics(address).is_null());
    EXPECT_EQ(early.error(3), -32600);
    EXPECT_EQ(early.outcome.status, 0);
    const Conversation late =
        converse(start + request(1, "shutdown") + request(2, "textDocument/hover", place(0, 0)) +
                 opened("axim: F\n") + request(3, "shutdown") + notice("exit"));
    EXPECT_EQ(late.error(2), -32600);
    EXPECT_EQ(late.error(3), -32600);
    EXPECT_TRUE(late.diagnostics(address).is_null());
    EXPECT_EQ(late.outcome.status, 0);
    const Conversation unknown =
        converse(start + request(1, "textDocument/fly") + notice("$/fly") + notice("textDocument/didSave") + end);
    EXPECT_EQ(unknown.error(1), -32601);
    EXPECT_EQ(unknown.messages.size(), 3u);
    EXPECT_EQ(unknown.outcome.status, 0);
}

TEST(Lsp, RefusesWhatIsNotAMessage) {
    for (const char* text :
         {"", "{", "null", "[]", "3", "\"initialize\"", "{}", R"({"id": 1})", R"({"id": 1, "method": 3})",
          "{\"id\": 1, \"method\": \"\xFF\"}", R"({"id": 1, "method": "initialize", "id": 2})"}) {
        const Conversation talk = converse(message(text) + start + end);
        ASSERT_FALSE(talk.messages.empty());
        EXPECT_LT(talk.messages.front()["error"]["code"], -32000) << text;
        EXPECT_EQ(talk.outcome.status, 0) << text << ": the server does not end";
    }
    for (const char* parameters : {"null", "[]", "3", "{\"textDocument\": 3}", "{\"textDocument\": {\"uri\": 3}}",
                                   "{\"textDocument\": {\"uri\": \"x\"}}", "{\"textDocument\": {\"text\": \"\"}}"}) {
        const std::string text = parameters;
        std::string input = start;
        for (const char* method : {"didOpen", "didChange", "didClose"}) {
            input += message(R"({"method": "textDocument/)" + std::string(method) + R"(", "params": )" + text + "}");
        }
        const Conversation talk = converse(input + end);
        for (const Json& each : talk.messages) {
            EXPECT_TRUE(each.contains("result") || each["method"] == "window/logMessage") << each;
        }
        EXPECT_GT(talk.messages.size(), 3u) << text;
        EXPECT_EQ(talk.outcome.status, 0) << text;
    }
    for (const std::string header : {"\r\n\r\n", "Content-Length: x\r\n\r\n{}", "Content-Length: -5\r\n\r\n{}",
                                     "GET / HTTP/1.1\r\nHost: x\r\n\r\n"}) {
        const Conversation talk = converse(start + header + end);
        EXPECT_EQ(talk.outcome.status, 1) << header;
        EXPECT_TRUE(has(talk.messages.back()["error"]["message"].get<std::string>(), "Content-Length")) << header;
    }
    EXPECT_EQ(converse(start + "Content-Length: 100\r\n\r\n{").outcome.status, 1) << "cut off";
    EXPECT_EQ(converse(std::string(100'000, 'x')).outcome.status, 1);
}

/// The messages shown to the user, in notifications.
std::vector<std::string> told(const Conversation& talk) {
    std::vector<std::string> messages;
    for (const Json& each : talk.messages) {
        if (each.value("method", "") == "window/showMessage") messages.push_back(each["params"]["message"]);
    }
    return messages;
}

TEST(Lsp, SaysThatADocumentIsTooLarge) {
    std::string huge = "axiom: F\n";
    while (huge.size() < (std::size_t{64} << 20U)) huge += std::string(1023, 'F') + "\n";
    const Conversation talk =
        converse(start + opened(huge) + request(1, "textDocument/rename", place(0, 0)) +
                 request(2, "textDocument/formatting", document()) + changed("axim: F\n") + end);
    EXPECT_EQ(talk.error(1), -32803);
    EXPECT_EQ(talk.error(2), -32803);
    EXPECT_TRUE(has(talk.reason(1), "too large"));
    EXPECT_EQ(talk.diagnostics(address).size(), 2u) << "the document that is small again";
    EXPECT_LT(talk.outcome.seconds, 60);
    if (!sanitized) {
        EXPECT_LT(talk.outcome.peak, 700'000) << "kilobytes";
    }
    const Conversation only = converse(start + opened(huge) + end);
    ASSERT_EQ(only.diagnostics(address).size(), 1u);
    const std::string message = only.diagnostics(address)[0]["message"];
    EXPECT_TRUE(has(message, "67.1 MB is too large for an editor and is not read; the limits are 4 MB")) << message;
    EXPECT_EQ(told(only), std::vector<std::string>{"/tmp/test.lsys: " + message});
}

/// Requests that editors send automatically get an empty answer. The user is informed once.
TEST(Lsp, IsSilentAboutDocumentsThatAreTooLarge) {
    const std::size_t limit = std::size_t{4} << 20U;
    std::string text = "axiom: F\n";
    text += "//" + std::string(limit - text.size() - 3, 'x') + "\n";
    ASSERT_EQ(text.size(), limit);
    std::string input = start + opened(text + "\n");
    int id = 0;
    for (const char* method : {"hover", "completion", "definition", "codeLens", "semanticTokens/full"}) {
        input += request(++id, std::string("textDocument/") + method, place(0, 0));
    }
    input += changed(text + "//") + request(10, "textDocument/documentColor", place(0, 0));
    const Conversation large = converse(input + end);
    for (int each = 1; each <= id; ++each) {
        EXPECT_TRUE(large.answer(each).contains("result") && large.result(each).is_null()) << large.answer(each);
    }
    EXPECT_EQ(large.result(10), Json::array());
    EXPECT_EQ(told(large).size(), 1u);
    const Conversation again = converse(input + changed(text) + request(11, "textDocument/hover", place(0, 0)) +
                                        changed(text + "\n") + request(12, "shutdown") + notice("exit"));
    EXPECT_FALSE(again.result(11).is_null()) << "a document of 4 MB is read";
    EXPECT_EQ(told(again).size(), 2u) << "it was too large twice";
}

/// The seventeenth document of 4 MB is over the limit of all; when another was closed, its next change is read.
TEST(Lsp, LimitsOpenDocumentsTogether) {
    const std::string text = "axim: F\n//" + std::string((std::size_t{4} << 20U) - 20, 'x') + "\n";
    std::string input = start;
    const auto name = [](int i) { return "file:///tmp/" + std::to_string(i); };
    for (int i = 0; i < 17; ++i) input += opened(text, name(i));
    const Conversation full = converse(input + end);
    EXPECT_EQ(full.diagnostics(name(15)).size(), 2u);
    ASSERT_EQ(full.diagnostics(name(16)).size(), 1u);
    EXPECT_EQ(told(full).size(), 1u);
    const Conversation freed =
        converse(input + notice("textDocument/didClose", document(name(3))) + changed(text, name(16)) + end);
    EXPECT_EQ(freed.diagnostics(name(16)).size(), 2u);
}

/// The server stops reading documents below the limit that take too long.
TEST(Lsp, TakesBoundedTimeForLargeDocuments) {
    std::string large = "axiom: F\nderivation length: 2\n";
    for (int i = 0; large.size() < 4'000'000; ++i) {
        large += "A" + std::string(1, static_cast<char>('a' + i % 26)) + "(x, y) : x > " + std::to_string(i) +
                 " --> F(x)[+(y)A(x)]\n";
    }
    const Conversation talk = converse(start + opened(large) + request(1, "textDocument/hover", place(5, 0)) +
                                       request(2, "textDocument/codeLens", document()) + end);
    EXPECT_FALSE(talk.diagnostics(address).is_null());
    EXPECT_TRUE(talk.answer(2).contains("result"));
    EXPECT_LT(talk.outcome.seconds, sanitized ? 120 : 20);
}

/// The digits of a text, without the commas that make them readable.
std::string digits_of(const std::smatch& match, std::size_t group) {
    std::string text = match[group];
    std::erase(text, ',');
    return text;
}

/// Compares the sizes above the derivation length with those that the pattern states: `// expect: symbols 3803, …`.
void expect_sizes(const std::string& text, const std::string& title) {
    static const std::regex word(R"(^n = \d+: ([\d,]+) symbols?, ([\d,]+) segments?)");
    static const std::regex map(R"(^n = \d+: ([\d,]+) cells?, ([\d,]+) edges?$)");
    static const std::regex stated_word(R"(// expect: symbols (\d+), drawn (\d+), moves (\d+))");
    static const std::regex stated_map(R"(// expect: cells (\d+), edges (\d+))");
    std::smatch shown, stated;
    if (std::regex_search(text, stated, stated_map)) {
        ASSERT_TRUE(std::regex_search(title, shown, map)) << title;
        EXPECT_EQ(digits_of(shown, 2), stated[2]);
    } else {
        ASSERT_TRUE(std::regex_search(text, stated, stated_word));
        ASSERT_TRUE(std::regex_search(title, shown, word)) << title;
        EXPECT_EQ(digits_of(shown, 2), stated[has(text, "\nline: spline") ? 3 : 2]);
    }
    EXPECT_EQ(digits_of(shown, 1), stated[1]);
}

TEST(Lsp, ServesEveryPattern) {
    const auto files = pattern_files("patterns");
    std::string input = start;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string name = "file://" + files[i].string();
        const int id = static_cast<int>(10 * i);
        input += opened(contents(files[i]), name) + request(id + 1, "textDocument/codeLens", document(name)) +
                 request(id + 2, "textDocument/formatting", document(name)) +
                 request(id + 3, "textDocument/semanticTokens/full", document(name)) +
                 request(id + 4, "textDocument/documentColor", document(name));
        for (int line = 0; line < 5; ++line) {
            Json parameters = document(name);
            parameters["position"] = {{"line", 3 * line}, {"character", 2}};
            input += request(id + 5 + line, "textDocument/hover", parameters);
        }
    }
    const Conversation talk = converse(input + end);
    std::size_t measured = 0, helped = 0;
    for (std::size_t i = 0; i < files.size(); ++i) {
        SCOPED_TRACE(files[i].string());
        const int id = static_cast<int>(10 * i);
        const std::string text = contents(files[i]);
        const Json list = talk.diagnostics("file://" + files[i].string());
        ASSERT_TRUE(list.is_array());
        for (const Json& each : list) EXPECT_EQ(each["severity"], 2) << each;
        if (const Json lenses = talk.result(id + 1); has(text, "\nderivation length:")) {
            ASSERT_FALSE(lenses.empty());
            expect_sizes(text, lenses[0]["command"]["title"]);
            ++measured;
        }
        EXPECT_EQ(talk.result(id + 2), Json::array()) << "bundled patterns are formatted";
        EXPECT_FALSE(talk.result(id + 3)["data"].empty());
        EXPECT_EQ(talk.result(id + 4).empty(), !std::regex_search(text, std::regex("#[0-9a-f]{3}|white|black")));
        for (int line = 0; line < 5; ++line) {
            EXPECT_TRUE(talk.answer(id + 5 + line).contains("result"));
            helped += talk.result(id + 5 + line).is_null() ? 0 : 1;
        }
    }
    EXPECT_GT(measured, 150u);
    EXPECT_GT(helped, files.size());
    EXPECT_LT(talk.outcome.seconds, sanitized ? 200 : 20);
}

TEST(Lsp, PrintsGrammars) {
    EXPECT_EQ(Json::parse(run({"lsp", "--grammar", "textmate"}).output)["scopeName"], "source.sikku");
    EXPECT_TRUE(has(run({"lsp", "--grammar", "vim"}).output, "b:current_syntax"));
    EXPECT_EQ(run({"lsp", "--grammar", "emacs"}).status, 2);
}

}  // namespace sikku::lsp_test
