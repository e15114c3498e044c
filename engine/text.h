// engine/text.h: texts, for all who write them to files.
#pragma once

#include <string>
#include <string_view>

namespace sikku {

/// ASCII letters in lower case, whatever the locale; other bytes as they are.
std::string lower_case(std::string_view text);

/// True if XML 1.0 can hold `text`: UTF-8 without control characters.
bool fits_xml(std::string_view text);
/// For XML and HTML, in elements and in attributes between double quotes. What XML cannot hold becomes U+FFFD.
std::string xml_escaped(std::string_view text);

/// A string of JSON with its quotes; `text` is UTF-8.
std::string json_string(std::string_view text);

/// Two small digits for each byte.
std::string to_hex(std::string_view bytes);

}  // namespace sikku
