#include "art/vector/pdf_x.h"

#include "art/print/micrometres.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <array>

namespace sikku {

const std::string& PdfColours::channels(Colour colour, bool is_drawn) {
    const bool is_black = is_black_ink(press_, colour, is_drawn);
    const auto [found, is_new] = known_.try_emplace({colour.red, colour.green, colour.blue, is_black});
    std::string& text = found->second;
    if (!is_new) return text;
    if (is_black) {
        text = "0 0 0 1";
    } else if (press_.inks) {
        const std::array<double, 4> inks = press_.inks->convert(colour);
        text = fmt::format("{} {} {} {}", decimal(inks[0], 4), decimal(inks[1], 4), decimal(inks[2], 4),
                           decimal(inks[3], 4));
    } else {
        text = fmt::format("{} {} {}", decimal(colour.red / 255.0, 4), decimal(colour.green / 255.0, 4),
                           decimal(colour.blue / 255.0, 4));
    }
    return text;
}

std::string pdf_x_information() {
    return "/CreationDate (D:20100101000000Z)\n/ModDate (D:20100101000000Z)\n/Trapped /False\n"
           "/GTS_PDFXVersion (PDF/X-4)\n";
}

std::string pdf_x_metadata(std::string_view title, std::string_view id) {
    const std::string uuid = fmt::format("uuid:{}-{}-{}-{}-{}", id.substr(0, 8), id.substr(8, 4), id.substr(12, 4),
                                         id.substr(16, 4), id.substr(20, 12));
    constexpr std::string_view date = "2010-01-01T00:00:00Z";
    return fmt::format(
        "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
        "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
        "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
        "<rdf:Description rdf:about=\"\"\n"
        "  xmlns:dc=\"http://purl.org/dc/elements/1.1/\"\n"
        "  xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\"\n"
        "  xmlns:xmpMM=\"http://ns.adobe.com/xap/1.0/mm/\"\n"
        "  xmlns:pdf=\"http://ns.adobe.com/pdf/1.3/\"\n"
        "  xmlns:pdfxid=\"http://www.npes.org/pdfx/ns/id/\">\n"
        "<dc:format>application/pdf</dc:format>\n"
        "<dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">{}</rdf:li></rdf:Alt></dc:title>\n"
        "<xmp:CreatorTool>Sikku</xmp:CreatorTool>\n"
        "<xmp:CreateDate>{}</xmp:CreateDate>\n"
        "<xmp:ModifyDate>{}</xmp:ModifyDate>\n"
        "<xmp:MetadataDate>{}</xmp:MetadataDate>\n"
        "<xmpMM:DocumentID>{}</xmpMM:DocumentID>\n"
        "<xmpMM:VersionID>1</xmpMM:VersionID>\n"
        "<xmpMM:RenditionClass>default</xmpMM:RenditionClass>\n"
        "<pdf:Trapped>False</pdf:Trapped>\n"
        "<pdfxid:GTS_PDFXVersion>PDF/X-4</pdfxid:GTS_PDFXVersion>\n"
        "</rdf:Description>\n</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"r\"?>\n",
        xml_escaped(title), date, date, date, uuid);
}

}  // namespace sikku
