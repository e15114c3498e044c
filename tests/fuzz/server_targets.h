// tests/fuzz/server_targets.h: fuzz target that sends messages and a text to the language server, and asks everything
// about the text.
#pragma once

#include "engine/language/document.h"
#include "studio/editor/language_server.h"
#include "studio/editor/message_reader.h"
#include "studio/editor/text_edit.h"
#include "tests/fuzz/file_targets.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {

/// A server that has been initialized. Its messages must be valid, and no error internal.
class FuzzedServer {
public:
    FuzzedServer() { ask("initialize", Json::object()); }
    void receive(const std::string& message) { server_.receive(message); }
    void work() {
        while (server_.has_work() && !server_.has_ended()) server_.work();
        server_.publish();
    }
    void tell(const std::string& method, const Json& parameters) {
        receive(
            Json({{"method", method}, {"params", parameters}}).dump(-1, ' ', false, Json::error_handler_t::replace));
        work();
    }
    /// The result, or null for an error.
    Json ask(const std::string& method, const Json& parameters) {
        result_ = nullptr;
        receive(Json({{"id", "fuzz"}, {"method", method}, {"params", parameters}}).dump());
        work();
        return std::move(result_);
    }

private:
    /// Ranges begin before they end.
    static void must_have_ranges(const Json& value) {
        if (value.is_object() && value.contains("start") && value.contains("end")) {
            const auto place = [&](const char* name) {
                return std::pair(value[name]["line"].get<std::size_t>(), value[name]["character"].get<std::size_t>());
            };
            must(place("start") <= place("end"), "a range ends before it begins");
        } else if (value.is_structured()) {
            for (const Json& each : value) must_have_ranges(each);
        }
    }
    void take(const std::string& message) {
        const Json answer = Json::parse(message);
        must(answer["jsonrpc"] == "2.0", "not a message");
        must_have_ranges(answer);
        if (answer.contains("error")) must(answer["error"]["code"] != -32603, "an internal error: " + message);
        if (answer.contains("result") && answer["id"] == "fuzz") result_ = answer["result"];
    }

    LanguageServer server_{[this](const std::string& message) { take(message); }};
    Json result_;
};

/// Messages are read as they were written, wherever their bytes are divided.
inline void try_reader(const std::vector<std::string>& messages, std::string_view any_bytes) {
    std::string bytes;
    for (const std::string& message : messages) bytes += with_header(message);
    const std::size_t step = 1 + any_bytes.size() % 7;
    MessageReader reader;
    std::size_t count = 0;
    for (std::size_t at = 0; at < bytes.size(); at += step) {
        reader.add(std::string_view(bytes).substr(at, step));
        while (const auto message = reader.next()) must(message->content == messages.at(count++), "another message");
    }
    must(count == messages.size() && !reader.is_broken(), "messages are lost");
    MessageReader other;
    other.add(any_bytes);
    while (const auto message = other.next()) {
        must(message->content.size() <= any_bytes.size(), "more than was sent");
    }
}

inline bool has_errors(const std::string& text) {
    Diagnostics diagnostics;
    Document::compile("fuzz.lsys", text, {}, diagnostics);
    return diagnostics.has_errors();
}

/// The text after the edits of an answer.
inline std::string with_answered(const std::string& text, const Json& edits) {
    const TextPositions positions(text);
    const auto offset = [&](const Json& place) { return positions.offset(place_of(place)); };
    std::vector<TextEdit> list;
    for (const Json& each : edits) {
        list.push_back({offset(each["range"]["start"]), offset(each["range"]["end"]), each["newText"]});
        must(list.size() == 1 || list[list.size() - 2].end <= list.back().begin, "edits overlap");
    }
    return with_edits(text, list);
}

/// Messages, one a line, up to the line `---`; then the text of a document. Without that line, the text alone.
inline void try_server(std::string_view bytes) {
    constexpr std::string_view divider = "---\n";
    std::size_t begin = bytes.find(divider);
    while (begin != std::string_view::npos && begin > 0 && bytes[begin - 1] != '\n') {
        begin = bytes.find(divider, begin + 1);
    }
    std::vector<std::string> messages;
    if (begin != std::string_view::npos) {
        for (std::string_view rest = bytes.substr(0, begin); !rest.empty();) {
            const std::size_t end = rest.find('\n');  // there is one
            messages.emplace_back(rest.substr(0, end));
            rest.remove_prefix(end + 1);
        }
        bytes.remove_prefix(begin + divider.size());
    }
    try_reader(messages, bytes);

    FuzzedServer server;
    for (const std::string& message : messages) server.receive(message);
    server.work();

    FuzzedServer asked;
    const Json document = {{"uri", "file:///none/fuzz.lsys"}};
    Json opened = document;
    opened["text"] = std::string(bytes);
    asked.tell("textDocument/didOpen", {{"textDocument", opened}});
    // Invalid bytes were replaced on the way.
    const std::string text = Json::parse(opened.dump(-1, ' ', false, Json::error_handler_t::replace))["text"];
    Json parameters = {{"textDocument", document}};
    for (const char* method : {"codeLens", "documentColor", "semanticTokens/full"}) {
        asked.ask(std::string("textDocument/") + method, parameters);
    }
    const Json formatting = asked.ask("textDocument/formatting", parameters);
    must(has_errors(with_answered(text, formatting)) == has_errors(text), "formatting changes the meaning");
    const TextPositions positions(text);
    std::size_t place = text.size() / 3;
    for (int question = 0; question < 3; ++question) {
        place = text.empty() ? 0 : (31 * place + static_cast<unsigned char>(text[place % text.size()])) % text.size();
        const EditorPosition position = positions.position(place);
        parameters["position"] = {{"line", position.line}, {"character", position.character}};
        for (const char* method : {"hover", "completion", "definition", "prepareRename"}) {
            asked.ask(std::string("textDocument/") + method, parameters);
        }
        for (const char* name : {"Zq", "Z"}) {
            parameters["newName"] = name;
            const Json renamed = asked.ask("textDocument/rename", parameters);
            if (renamed.is_null()) continue;
            must(!has_errors(with_answered(text, renamed["changes"]["file:///none/fuzz.lsys"])),
                 "renaming makes errors");
        }
    }
}

}  // namespace sikku
