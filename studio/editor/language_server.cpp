#include "studio/editor/language_server.h"

#include "art/prints.h"
#include "art/style/colour.h"
#include "engine/base/characters.h"
#include "engine/base/json.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"
#include "engine/check.h"
#include "engine/language/defines.h"
#include "music/scores.h"
#include "studio/editor/format.h"
#include "studio/editor/help.h"
#include "studio/editor/measures.h"
#include "studio/editor/rename.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <new>
#include <optional>
#include <utility>
#include <vector>

namespace sikku {
namespace {

using namespace std::chrono_literals;

/// Codes of JSON-RPC and of the protocol.
enum ErrorCode : int {
    parse_error = -32700,
    invalid_request = -32600,
    unknown_method = -32601,
    invalid_parameters = -32602,
    internal_error = -32603,
    not_initialized = -32002,
    request_cancelled = -32800,
    request_failed = -32803,
};

/// An error that the server sends as the answer to a request.
class ServerError : public std::runtime_error {
public:
    ServerError(int code, const std::string& message) : std::runtime_error(message), code_(code) {}
    int code() const { return code_; }

private:
    int code_;
};

/// Ends the work on a request because other messages arrived; the work starts again after these.
class Postponed {};

/// Stops work after some time, when the program is asked to stop, or when messages arrive.
class Deadline {
public:
    Deadline(std::chrono::milliseconds time, const Monitor& stop, const LanguageServer::HasNews* news = nullptr)
        : end_(std::chrono::steady_clock::now() + time), stop_(stop), news_(news) {}
    Monitor monitor() { return Monitor(&is_over, nullptr, this); }
    /// Call after Stopped was caught. @throws Stopped if the program is asked to stop; Postponed
    void require_timeout() const {
        stop_.check();
        if (has_news_) throw Postponed();
    }

private:
    static bool is_over(void* context) {
        auto* self = static_cast<Deadline*>(context);
        if (self->stop_.stop_requested() || std::chrono::steady_clock::now() >= self->end_) return true;
        if (self->news_ && *self->news_ && (*self->news_)()) self->has_news_ = true;
        return self->has_news_;
    }
    std::chrono::steady_clock::time_point end_;
    const Monitor& stop_;
    const LanguageServer::HasNews* news_;
    std::atomic<bool> has_news_ = false;
};

constexpr auto checking_time = 2s;
constexpr auto measuring_time = 500ms;

std::span<const Interpreter* const> all_interpreters() {
    static const std::array<const Interpreter*, 2> both = {&prints(), &scores()};
    return both;
}

/// The path in `file:///home/me/my%20pattern.lsys`; other addresses as they are.
std::string path_of(const std::string& address) {
    constexpr std::string_view scheme = "file://";
    if (!address.starts_with(scheme)) return address;
    std::string path;
    for (std::size_t at = scheme.size(); at < address.size(); ++at) {
        const auto value = [&](std::size_t place) {
            const char digit = place < address.size() ? lower_case(address.substr(place, 1))[0] : ' ';
            return is_digit(digit) ? digit - '0' : digit >= 'a' && digit <= 'f' ? digit - 'a' + 10 : -1;
        };
        if (address[at] == '%' && value(at + 1) >= 0 && value(at + 2) >= 0) {
            path += static_cast<char>(16 * value(at + 1) + value(at + 2));
            at += 2;
        } else {
            path += address[at];
        }
    }
    return path.find('\0') == std::string::npos ? path : address;
}

EditorPosition place_of(const Json& position) {
    return {position_of(position, "line"), position_of(position, "character")};
}

Json json_of(const EditorPosition& position) {
    return {{"line", position.line}, {"character", position.character}};
}

Json range_of(const TextPositions& positions, std::size_t begin, std::size_t end) {
    return {{"start", json_of(positions.position(begin))}, {"end", json_of(positions.position(end))}};
}

Json range_of(const TextPositions& positions, const Span& span) {
    return range_of(positions, span.at, std::size_t{span.at} + span.length);
}

/// The end of the word or character at a byte; at a line end, the byte itself.
std::size_t end_of_word(std::string_view text, std::size_t begin) {
    std::size_t end = begin;
    if (end >= text.size() || text[end] == '\n' || text[end] == '\r') return end;
    if (begins_name(text[end])) {
        while (end < text.size() && continues_name(text[end])) ++end;
        return end;
    }
    return end + 1;  // other bytes are ASCII
}

Json markdown(const std::string& text) {
    return {{"kind", "markdown"}, {"value", text}};
}

/// Parts of a value that are separated by blanks or commas.
template <class Take>
void for_each_word(const Span& value, Take take) {
    std::string_view rest = value.view();
    for (std::string_view word = take_word(rest, " \t,"); !word.empty(); word = take_word(rest, " \t,")) {
        take(word, value.part(value.length - rest.size() - word.size(), word.size()));
    }
}

bool has_colours(const std::string& name) {
    const KeyInfo* key = find_language_key(lower_case(name));
    return key && key->owner == KeyOwner::art && key->values.find("colour") != std::string_view::npos;
}

/// Kinds of names that editors colour. The grammar colours symbols of one character.
constexpr std::array token_types = {"property", "class", "variable", "parameter", "operator", "function"};
std::optional<std::size_t> token_type(const Occurrence& name) {
    switch (name.kind) {
        case NameKind::key:
            return 0;
        case NameKind::table:
        case NameKind::variant:
        case NameKind::surface:
            return 1;
        case NameKind::define:
            return 2;
        case NameKind::formal:
            return 3;
        case NameKind::arrow:
            return 4;
        case NameKind::symbol:
            if (name.where.length > utf8_length(name.where.view())) return 5;
            break;
    }
    return std::nullopt;
}

}  // namespace

/// A document as it is read for a request.
struct LanguageServer::View {
    explicit View(const OpenDocument& document)
        : pattern(parse_pattern(document.name, document.text, diagnostics)), positions(pattern.source->text()) {
        if (!diagnostics.is_unreadable()) names = occurrences(pattern);
    }
    std::size_t offset(const Json& parameters) const {
        return positions.offset(place_of(member(parameters, "position")));
    }
    const Occurrence* name_at(const Json& parameters) const { return find_occurrence(names, offset(parameters)); }
    Json edits(const std::vector<TextEdit>& list) const {
        Json result = Json::array();
        for (const TextEdit& edit : list) {
            result.push_back({{"range", range_of(positions, edit.begin, edit.end)}, {"newText", edit.text}});
        }
        return result;
    }

    Diagnostics diagnostics;
    Pattern pattern;
    TextPositions positions;
    std::vector<Occurrence> names;
};

struct LanguageServer::Method {
    std::string_view name;
    Answer answer;
};

const LanguageServer::Method* LanguageServer::find_method(std::string_view name) {
    static constexpr std::array methods = {
        Method{"initialize", &LanguageServer::initialize},
        Method{"shutdown", &LanguageServer::shutdown},
        Method{"textDocument/hover", &LanguageServer::hover},
        Method{"textDocument/completion", &LanguageServer::completion},
        Method{"textDocument/definition", &LanguageServer::definition},
        Method{"textDocument/prepareRename", &LanguageServer::prepare_rename},
        Method{"textDocument/rename", &LanguageServer::rename},
        Method{"textDocument/formatting", &LanguageServer::format},
        Method{"textDocument/documentColor", &LanguageServer::colours},
        Method{"textDocument/colorPresentation", &LanguageServer::colour_texts},
        Method{"textDocument/codeLens", &LanguageServer::lenses},
        Method{"textDocument/semanticTokens/full", &LanguageServer::tokens},
    };
    const auto* found =
        std::find_if(methods.begin(), methods.end(), [&](const Method& method) { return method.name == name; });
    return found == methods.end() ? nullptr : found;
}

// --- messages ---------------------------------------------------------------------------------------------------

void LanguageServer::reply(const Json& id, const char* member, Json value) {
    const Json message = {{"jsonrpc", "2.0"}, {"id", id}, {member, std::move(value)}};
    // Messages can contain incomplete characters.
    send_(message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void LanguageServer::notify(const char* method, Json parameters) {
    const Json message = {{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(parameters)}};
    send_(message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void LanguageServer::refuse(const std::string& reason) {
    reply(nullptr, "error", {{"code", invalid_request}, {"message", reason}});
}

void LanguageServer::receive(const std::string& message) {
    try {
        Json request = read_json(message);
        if (!request.is_object()) throw ServerError(invalid_request, "expected an object");
        if (request.contains("method")) {
            if (request["method"] == "$/cancelRequest") {
                if (request.contains("params")) cancel(request["params"]);
            } else {
                waiting_.push_back(std::move(request));
            }
        } else if (!request.contains("result") && !request.contains("error")) {  // nor a response
            throw ServerError(invalid_request, "'method' is missing");
        }
    } catch (const JsonError& error) {
        const std::string reason = fmt::format("{}, at byte {}", error.what(), error.byte);
        reply(nullptr, "error", {{"code", parse_error}, {"message", reason}});
    } catch (const ServerError& error) {
        reply(nullptr, "error", {{"code", error.code()}, {"message", error.what()}});
    } catch (const std::bad_alloc&) {
        reply(nullptr, "error", {{"code", internal_error}, {"message", "not enough memory"}});
    }
}

/// Cancels a waiting request; a request that does not wait has been answered.
void LanguageServer::cancel(const Json& parameters) {
    if (!parameters.is_object() || !parameters.contains("id")) return;
    const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Json& request) {
        return request.contains("id") && request["id"] == parameters["id"];
    });
    if (found == waiting_.end()) return;
    waiting_.erase(found);
    reply(parameters["id"], "error", {{"code", request_cancelled}, {"message", "cancelled"}});
}

void LanguageServer::work() {
    if (waiting_.empty()) return;
    Json request = std::move(waiting_.front());
    waiting_.pop_front();
    const bool is_request = request.contains("id");
    Json id = nullptr, result;
    const auto fail = [&](int code, const std::string& reason) {
        if (is_request) return reply(id, "error", {{"code", code}, {"message", reason}});
        constexpr int error = 1;
        notify("window/logMessage", {{"type", error}, {"message", reason}});
    };
    try {
        if (is_request && (request["id"].is_string() || request["id"].is_number())) id = request["id"];
        const std::string method = text_of(request, "method");
        const Json none = Json::object();
        const auto found = request.find("params");
        const Json& parameters = found == request.end() ? none : *found;
        if (!is_request) return notice(method, parameters);
        publish();
        result = answer(method, parameters);
    } catch (const Postponed&) {
        waiting_.push_back(std::move(request));
        return;
    } catch (const ServerError& error) {
        return fail(error.code(), error.what());
    } catch (const BadRequest& error) {
        return fail(invalid_parameters, error.what());
    } catch (const RenameError& error) {
        return fail(request_failed, error.what());
    } catch (const std::bad_alloc&) {
        return fail(internal_error, "not enough memory");
    } catch (const Stopped&) {
        stop_.check();
        return fail(request_failed, "this takes too long");
    } catch (const PatternError&) {
        return fail(request_failed, "the pattern has errors");
    } catch (const std::exception& error) {
        return fail(internal_error, error.what());
    }
    reply(id, "result", std::move(result));
}

Json LanguageServer::answer(const std::string& method, const Json& parameters) {
    if (is_shut_down_) throw ServerError(invalid_request, "the server has been shut down");
    if (!is_initialized_ && method != "initialize") {
        throw ServerError(not_initialized, "expected the request 'initialize' before any other");
    }
    const Method* found = find_method(method);
    if (!found) throw ServerError(unknown_method, fmt::format("unknown method '{}'", printable(method, 80)));
    return (this->*found->answer)(parameters);
}

void LanguageServer::notice(const std::string& method, const Json& parameters) {
    if (method == "exit") has_ended_ = true;
    if (!is_initialized_ || is_shut_down_) return;
    if (method == "textDocument/didOpen") {
        const Json& document = member(parameters, "textDocument");
        put(document, text_of(document, "text"));
    } else if (method == "textDocument/didChange") {
        change(member(parameters, "textDocument"), member(parameters, "contentChanges"));
    } else if (method == "textDocument/didClose") {
        const std::string address = text_of(member(parameters, "textDocument"), "uri");
        const auto found = documents_.find(address);
        if (found == documents_.end()) return;
        open_bytes_ -= found->second.text.size();
        documents_.erase(found);
        notify("textDocument/publishDiagnostics", {{"uri", address}, {"diagnostics", Json::array()}});
    }
}

// --- documents --------------------------------------------------------------------------------------------------

void LanguageServer::put(const Json& document, const std::string& text) {
    const std::string address = text_of(document, "uri");
    OpenDocument& open = documents_[address];
    open_bytes_ -= open.text.size();
    open.name = path_of(address);
    open.size = text.size();
    open.is_changed = true;
    open.text.clear();
    if (text.size() <= most_document_bytes && open_bytes_ + text.size() <= most_open_bytes) open.text = text;
    open_bytes_ += open.text.size();
}

/// The server requests whole texts, but also accepts changed parts.
void LanguageServer::change(const Json& document, const Json& changes) {
    if (!changes.is_array()) throw BadRequest("'contentChanges' must be a list");
    for (const Json& each : changes) {
        std::string text = text_of(each, "text");
        if (each.contains("range")) {
            const auto found = documents_.find(text_of(document, "uri"));
            if (found == documents_.end()) throw BadRequest("the document is not open");
            const std::string& old = found->second.text;
            if (!found->second.is_served()) throw BadRequest("the document is too large");
            const TextPositions positions(old);
            const auto offset = [&](const char* name) {
                return positions.offset(place_of(member(each["range"], name)));
            };
            const std::size_t begin = offset("start");
            text = with_edits(old, {{begin, std::max(begin, offset("end")), text}});
        }
        put(document, text);
    }
}

const LanguageServer::OpenDocument& LanguageServer::document_of(const Json& parameters) const {
    const auto found = documents_.find(text_of(member(parameters, "textDocument"), "uri"));
    if (found == documents_.end()) throw BadRequest("the document is not open");
    if (!found->second.is_served()) throw ServerError(request_failed, "the document is too large");
    return found->second;
}

void LanguageServer::publish() {
    const bool changes = std::any_of(waiting_.begin(), waiting_.end(), [](const Json& message) {
        return message["method"] == "textDocument/didChange";
    });
    if (changes) return;
    for (auto& [address, document] : documents_) {
        if (!document.is_changed) continue;
        document.is_changed = false;
        notify("textDocument/publishDiagnostics", {{"uri", address}, {"diagnostics", diagnostics_of(document)}});
    }
}

Json LanguageServer::diagnostics_of(const OpenDocument& document) const {
    enum Severity : int { error = 1, warning = 2 };
    const TextPositions positions(document.text);
    const auto entry = [&](std::size_t begin, std::size_t end, int severity, const std::string& message) -> Json {
        return {{"range", range_of(positions, begin, end)},
                {"severity", severity},
                {"source", "sikku"},
                {"message", message}};
    };
    if (!document.is_served()) {
        return Json::array(
            {entry(0, 0, error,
                   fmt::format("this document of {} is too large for an editor; the limits are 4 MB for a "
                               "document and 64 MB for all open documents",
                               bytes_text(static_cast<double>(document.size))))});
    }
    Json list = Json::array();
    try {
        Deadline deadline(checking_time, stop_);
        for (const Diagnostic& one :
             check_pattern(document.name, document.text, all_interpreters(), deadline.monitor())) {
            const bool is_in_text = one.where.line > 0;
            const std::size_t begin = is_in_text ? positions.offset(one.where) : 0;
            const std::size_t end = is_in_text ? end_of_word(document.text, begin) : 0;
            list.push_back(entry(begin, end, one.warning ? warning : error,
                                 is_in_text ? one.message : one.file + ": " + one.message));
        }
    } catch (const Stopped&) {
        stop_.check();
        list.push_back(entry(0, 0, warning, "the pattern was not checked: checking takes longer than 2 s"));
    } catch (const std::bad_alloc&) {
        list.push_back(entry(0, 0, warning, "the pattern was not checked: not enough memory"));
    }
    return list;
}

// --- requests ---------------------------------------------------------------------------------------------------

Json LanguageServer::initialize(const Json& /*parameters*/) {
    if (is_initialized_) throw ServerError(invalid_request, "the server is already initialized");
    is_initialized_ = true;
    const Json capabilities = {
        {"textDocumentSync", {{"openClose", true}, {"change", 1}}},  // whole texts
        {"hoverProvider", true},
        {"completionProvider", {{"triggerCharacters", {":", " "}}}},
        {"definitionProvider", true},
        {"renameProvider", {{"prepareProvider", true}}},
        {"documentFormattingProvider", true},
        {"colorProvider", true},
        {"codeLensProvider", {{"resolveProvider", false}}},
        {"semanticTokensProvider",
         {{"legend", {{"tokenTypes", token_types}, {"tokenModifiers", Json::array()}}}, {"full", true}}}};
    return {{"capabilities", capabilities}, {"serverInfo", {{"name", "sikku"}, {"version", SIKKU_VERSION}}}};
}

Json LanguageServer::shutdown(const Json& /*parameters*/) {
    is_shut_down_ = true;
    return nullptr;
}

Json LanguageServer::hover(const Json& parameters) {
    const OpenDocument& document = document_of(parameters);
    const View view(document);
    const Occurrence* name = view.name_at(parameters);
    std::string help = name ? help_for(*name, view.pattern, view.names) : "";
    if (help.empty()) return nullptr;
    if (name->kind == NameKind::key && lower_case(name->where.view()) == "derivation length") {
        Diagnostics diagnostics;
        const Document compiled = Document::compile(document.name, document.text, {}, diagnostics);
        Deadline deadline(measuring_time, stop_, &news_);
        try {
            if (!diagnostics.has_errors()) help += "\n\n" + growth_table(compiled, deadline.monitor());
        } catch (const Stopped&) {
            deadline.require_timeout();
        }
    }
    return {{"contents", markdown(help)}, {"range", range_of(view.positions, name->where)}};
}

Json LanguageServer::completion(const Json& parameters) {
    enum ItemKind : int { property = 10, value = 12 };
    const View view(document_of(parameters));
    const std::size_t cursor = view.offset(parameters);
    const Completions found = complete(view.pattern, cursor);
    const Json range = range_of(view.positions, found.begin, cursor);
    Json items = Json::array();
    for (const Completion& each : found.items) {
        Json item = {{"label", each.label},
                     {"kind", each.is_key ? property : value},
                     {"textEdit", {{"range", range}, {"newText", each.insert}}}};
        if (!each.detail.empty()) item["detail"] = each.detail;
        if (!each.help.empty()) item["documentation"] = markdown(each.help);
        items.push_back(std::move(item));
    }
    return {{"isIncomplete", false}, {"items", std::move(items)}};
}

Json LanguageServer::definition(const Json& parameters) {
    const View view(document_of(parameters));
    const Occurrence* name = view.name_at(parameters);
    if (!name) return nullptr;
    Json places = Json::array();
    for (const Occurrence& each : view.names) {
        if (!each.is_definition || !each.is_same(*name)) continue;
        places.push_back({{"uri", member(member(parameters, "textDocument"), "uri")},
                          {"range", range_of(view.positions, each.where)}});
    }
    return places;
}

Json LanguageServer::prepare_rename(const Json& parameters) {
    const View view(document_of(parameters));
    const Occurrence* name = view.name_at(parameters);
    require_renamable(name);
    return {{"range", range_of(view.positions, name->where)}, {"placeholder", name->where.view()}};
}

Json LanguageServer::rename(const Json& parameters) {
    const View view(document_of(parameters));
    const Occurrence* name = view.name_at(parameters);
    require_renamable(name);
    const std::vector<TextEdit> edits = renaming(view.pattern, view.names, *name, text_of(parameters, "newName"));
    Json changes = Json::object();
    changes[text_of(member(parameters, "textDocument"), "uri")] = view.edits(edits);
    return {{"changes", std::move(changes)}};
}

Json LanguageServer::format(const Json& parameters) {
    const View view(document_of(parameters));
    if (view.diagnostics.is_unreadable()) return Json::array();
    return view.edits(formatting(view.pattern));
}

Json LanguageServer::colours(const Json& parameters) {
    const View view(document_of(parameters));
    Json list = Json::array();
    const auto look = [&](const Key& key) {
        if (!has_colours(key.name)) return;
        for_each_word(key.value, [&](std::string_view word, const Span& where) {
            const auto colour = parse_colour(word);
            if (!colour) return;
            const auto share = [](std::uint8_t channel) { return channel / 255.0; };
            list.push_back({{"range", range_of(view.positions, where)},
                            {"color",
                             {{"red", share(colour->red)},
                              {"green", share(colour->green)},
                              {"blue", share(colour->blue)},
                              {"alpha", share(colour->alpha)}}}});
        });
    };
    for (const Key& key : view.pattern.keys) {
        if (key.value.source == view.pattern.source.get()) look(key);
    }
    for (const Variant& variant : view.pattern.variants) {
        for (const Key& setting : variant.settings) look(setting);
    }
    return list;
}

Json LanguageServer::colour_texts(const Json& parameters) {
    const Json& colour = member(parameters, "color");
    const auto channel = [&](const char* name, double otherwise) {
        return static_cast<unsigned>(std::lround(255 * std::clamp(number_of(colour, name, otherwise), 0.0, 1.0)));
    };
    std::string text = fmt::format("#{:02x}{:02x}{:02x}", channel("red", 0), channel("green", 0), channel("blue", 0));
    const unsigned alpha = channel("alpha", 1);
    Json list = Json::array();
    if (alpha < 255) {
        list.push_back({{"label", fmt::format("{}{:02x}", text, alpha)}});
        return list;
    }
    const std::string name = colour_name(*parse_colour(text));
    list.push_back({{"label", text}});
    if (name != text) list.push_back({{"label", name}});
    return list;
}

Json LanguageServer::lenses(const Json& parameters) {
    const OpenDocument& document = document_of(parameters);
    const View view(document);
    Json list = Json::array();
    Deadline deadline(measuring_time, stop_, &news_);
    const auto add = [&](const Document& drawn, const Span& where) {
        const std::string text = measures_text(drawn, deadline.monitor());
        if (text.empty()) return;
        list.push_back(
            {{"range", range_of(view.positions, where)},
             {"command", {{"title", fmt::format("n = {}: {}", drawn.grammar().steps(), text)}, {"command", ""}}}});
    };
    const auto compiled = [&](const std::string& variant) -> std::optional<Document> {
        Diagnostics diagnostics;
        Document result = Document::compile(document.name, document.text, {variant, {}}, diagnostics);
        return diagnostics.has_errors() ? std::nullopt : std::optional(std::move(result));
    };
    try {
        const auto plain = compiled("");
        const Key* length = view.pattern.find("derivation length");
        if (plain && length) {
            add(*plain, length->name_at);
            try {
                const auto next = static_cast<std::int64_t>(plain->grammar().steps()) + 1;
                add(plain->with({{"derivation length", fmt::format("{}", next)}}), length->name_at);
            } catch (const PatternError&) {  // the schedule ends there
            }
        }
        for (const Variant& variant : view.pattern.variants) {
            deadline.monitor().check();
            if (const auto varied = compiled(std::string(variant.name.view()))) add(*varied, variant.name);
        }
    } catch (const Stopped&) {
        deadline.require_timeout();  // those found so far are shown
    }
    return list;
}

Json LanguageServer::tokens(const Json& parameters) {
    const View view(document_of(parameters));
    Json data = Json::array();
    EditorPosition last;
    for (const Occurrence& each : view.names) {
        const auto type = token_type(each);
        if (!type) continue;
        const EditorPosition begin = view.positions.position(each.where.at);
        const EditorPosition end = view.positions.position(std::size_t{each.where.at} + each.where.length);
        if (end.line != begin.line) continue;  // a continued line
        data.push_back(begin.line - last.line);
        data.push_back(begin.line == last.line ? begin.character - last.character : begin.character);
        data.push_back(end.character - begin.character);
        data.push_back(*type);
        data.push_back(0);
        last = begin;
    }
    return {{"data", std::move(data)}};
}

}  // namespace sikku
