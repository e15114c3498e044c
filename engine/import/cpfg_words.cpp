#include "engine/import/cpfg_words.h"

namespace sikku::cpfg {
namespace {

bool moves_the_turtle(char byte) {
    return std::string_view("FfGg+-|[]{}#!;,'%@&^/\\$").find(byte) != std::string_view::npos;
}

void append(std::string& result, std::string_view letter, const std::vector<std::string>& arguments) {
    result += letter;
    for (std::size_t i = 0; i < arguments.size(); ++i) result += (i == 0 ? '(' : ',') + arguments[i];
    if (!arguments.empty()) result += ')';
}

}  // namespace

void check_symbol(char byte, std::size_t at) {
    const auto code = static_cast<unsigned char>(byte);
    if (code >= 0x80 || code < 0x20 || code == 0x7F) mistake(at, "a symbol is one character of ASCII");
    if (byte == ':' || byte == '*' || byte == '(' || byte == ')' || byte == '<' || byte == '>') {
        mistake(at, fmt::format("'{}' is not a symbol", byte));
    }
}

bool is_arrow(const Reader& reader) {
    return reader.ahead().starts_with("-->") || reader.ahead().starts_with("-o>");
}

/// Reads one symbol, or two characters after '@'. A surface's name after '~' is not a command of the turtle.
std::string Words::symbol(Reader& reader) {
    const std::size_t at = reader.where();
    const char byte = reader.peek();
    check_symbol(byte, at);
    reader.take();
    if (std::exchange(after_tilde_, byte == '~') && moves_the_turtle(byte)) return surface(byte);
    if (byte != '@') {
        letters.symbols.insert(std::string(1, byte));
        return std::string(1, byte);
    }
    const char function = reader.peek();
    if (function == 0) mistake(at, "expected a function after '@'");
    check_symbol(function, reader.where());
    reader.take();
    letters.symbols.insert({'@', function});
    letters.called.insert(function);
    if (std::string_view("ocOv").find(function) == std::string_view::npos) {
        report_.once(std::string("@") + function, at, fmt::format("the function @{}", function));
    }
    return {'@', function};
}

/// A Greek letter, which no cpfg file uses, for a surface whose name would move the turtle.
std::string Words::surface(char byte) {
    std::string& letter = letters.surfaces[byte];
    if (letter.empty()) {
        const std::size_t number = letters.surfaces.size() - 1;  // fewer than the turtle has commands
        letter = {'\xCE', static_cast<char>(0x91 + number)};
        if (letter == "\xCE\x95") letter = "\xCE\xB1";  // capital epsilon resembles the empty word
    }
    letters.symbols.insert(letter);
    return letter;
}

void Words::note(char letter, std::size_t at) {
    if (letter == '~') report_.once("~", at, "surfaces");
    if (letter == ';' || letter == ',') report_.once(";", at, "the colours, which are in a separate colour map");
    if (letter == '?' || letter == '$') report_.once("?", at, "queries and sub-L-systems");
}

std::string Words::word(Reader& reader, bool is_drawn) {
    std::string result;
    after_tilde_ = false;
    while (true) {
        const char byte = reader.peek();
        if (byte == 0 || byte == ':') break;
        const std::size_t at = reader.where();
        if (byte == '*') mistake(at, "'*' is the empty word and must stand alone");
        const std::string letter = symbol(reader);
        note(letter[0], at);
        std::vector<std::string> arguments;
        if (reader.peek() == '(') {
            arguments = parameters(reader, reader.where(), [&] { return expressions_.read(reader).text; });
        }
        if (letter == "%" && !arguments.empty()) {
            report_.once("%(", at, "%() with parameters");
            continue;
        }
        if (is_drawn) {
            finish(result, letter, std::move(arguments), at);
            continue;
        }
        if ((letter == "!" || letter == "#") && arguments.empty() && view_.width_increment != 0) {
            report_.once("!", at, "steps of # and ! in pixels: here they multiply the width by 1.25 and 0.8");
        }
        if ((letter == "{" || letter == "}") && !arguments.empty() && arguments[0] != "0") {
            report_.once("{(", at, "generalised cylinders");
        }
        note_width(letter, arguments);
        letters.modules.insert({letter, arguments.size()});
        append(result, letter, arguments);
    }
    return result;
}

/// Finishes a module in a homomorphism's successor, which the turtle reads directly.
void Words::finish(std::string& result, const std::string& letter, std::vector<std::string> arguments,
                   std::size_t at) {
    if (letter == "%" || letter == "'" || letter == "@." || letter == "$") return;
    if (letter == "@v") return append(result, "$", {});
    if (letter == "/" || letter == "\\") return append(result, letter == "/" ? "\\" : "/", arguments);
    if ((letter == "!" || letter == "#") && arguments.empty()) {
        if (view_.width_increment == 0) return;
        report_.once("!", at, "steps of # and ! in pixels: here they multiply the width by 1.25 and 0.8");
    }
    if (letter == "@o" || letter == "@c" || letter == "@O") {
        if (arguments.empty()) return report_.once("disc", at, "discs as wide as the line");
        return append(result, "@O", {"(" + arguments[0] + ")/2"});
    }
    if ((letter == "{" || letter == "}") && !arguments.empty()) {
        if (arguments[0] != "0") return report_.once("{(", at, "generalised cylinders");
        arguments.clear();
    }
    note_width(letter, arguments);
    append(result, letter, arguments);
}

/// Records modules that set widths. Widths are in pixels unless the view states otherwise.
void Words::note_width(const std::string& letter, const std::vector<std::string>& arguments) {
    if ((letter == "!" || letter == "#") && !arguments.empty()) letters.sets_width = true;
}

/// Reads the parameters of a module from their parenthesis on. @param at  place of the error if there are too many
std::vector<std::string> Words::parameters(Reader& reader, std::size_t at, const std::function<std::string()>& read) {
    std::vector<std::string> list;
    do {
        reader.take();
        list.push_back(read());
        if (list.size() > most_parameters) mistake(at, "a module has at most 64 parameters");
    } while (expressions_.next(reader) == ',');
    if (!expressions_.takes(reader, ')')) mistake(reader.where(), "expected ',' or ')' after a parameter");
    return list;
}

std::vector<Formal> Words::formal_modules(Reader& reader) {
    std::vector<Formal> modules;
    after_tilde_ = false;
    if (reader.takes('*')) return modules;
    while (true) {
        const char byte = reader.peek();
        if (byte == 0 || byte == '<' || byte == '>' || byte == ':' || is_arrow(reader)) return modules;
        const std::size_t at = reader.where();
        Formal module{symbol(reader), {}};
        if (module.letter[0] != '@') letters.named.insert(module.letter[0]);
        if (module.letter == "%") lose(at, "the cut symbol is removed before productions apply");
        if (reader.peek() == '(') {
            module.names = parameters(reader, at, [&] {
                std::string name = expressions_.identifier(reader);
                if (name.empty()) mistake(reader.where(), "expected the name of a parameter");
                if (defines_.macros.contains(name)) {
                    mistake(reader.where(), fmt::format("the parameter '{}' is a define", printable(name, 80)));
                }
                if (!expressions_.add_formal(name)) {
                    mistake(reader.where(), fmt::format("the parameter '{}' is named twice", printable(name, 80)));
                }
                return name;
            });
        }
        modules.push_back(std::move(module));
    }
}

}  // namespace sikku::cpfg
