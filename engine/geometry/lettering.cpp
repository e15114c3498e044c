#include "engine/geometry/lettering.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/geometry/tamil.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace sikku {
namespace {

// The Hershey Fonts were originally created by Dr. A. V. Hershey while working at the U. S. National Bureau of
// Standards. The format of the font data in this distribution was originally created by James Hurt, Cognition, Inc.,
// 900 Technology Park Drive, Billerica, MA 01821 (mit-eddie!ci-dandelion!hurt).
//
// A glyph is a list of points, two characters each, counted from `R`, y down; first the left and the right border;
// ` R` lifts the pen. Capital letters reach from `F` down to `[`. The hyphen is ours, as are the glyphs below.
constexpr std::array<std::string_view, 95> ascii_glyphs = {
    // clang-format off
    R"(JZ)", R"(MWRFRT RRYQZR[SZRY)", R"(JZNFNM RVFVM)", R"(H]SBLb RYBRb RLOZO RKUYU)",
    R"(H\PBP_ RTBT_ RYIWGTFPFMGKIKKLMMNOOUQWRXSYUYXWZT[P[MZKX)",
    R"(F^[FI[ RNFPHPJOLMMKMIKIIJGLFNFPGSHVHYG[F RWTUUTWTYV[X[ZZ[X[VYTWT)",
    R"(E_\O\N[MZMYNXPVUTXRZP[L[JZIYHWHUISJRQNRMSKSIRGPFNGMIMKNNPQUXWZY[[[\Z\Y)", R"(MWRHQGRFSGSIRKQL)",
    R"(KYVBTDRGPKOPOTPYR]T`Vb)", R"(KYNBPDRGTKUPUTTYR]P`Nb)", R"(JZRLRX RMOWU RWOMU)", R"(E_RIR[ RIR[R)",
    R"(NVSWRXQWRVSWSYQ[)", R"(JZMRWR)", R"(NVRVQWRXSWRV)", R"(G][BIb)", R"(H\QFNGLJKOKRLWNZQ[S[VZXWYRYOXJVGSFQF)",
    R"(H\NJPISFS[)", R"(H\LKLJMHNGPFTFVGWHXJXLWNUQK[Y[)", R"(H\MFXFRNUNWOXPYSYUXXVZS[P[MZLYKW)",
    R"(H\UFKTZT RUFU[)", R"(H\WFMFLOMNPMSMVNXPYSYUXXVZS[P[MZLYKW)",
    R"(H\XIWGTFRFOGMJLOLTMXOZR[S[VZXXYUYTXQVOSNRNOOMQLT)", R"(H\YFO[ RKFYF)",
    R"(H\PFMGLILKMMONSOVPXRYTYWXYWZT[P[MZLYKWKTLRNPQOUNWMXKXIWGTFPF)",
    R"(H\XMWPURRSQSNRLPKMKLLINGQFRFUGWIXMXRWWUZR[P[MZLX)", R"(NVROQPRQSPRO RRVQWRXSWRV)",
    R"(NVROQPRQSPRO RSWRXQWRVSWSYQ[)", R"(F^ZIJRZ[)", R"(E_IO[O RIU[U)", R"(F^JIZRJ[)",
    R"(I[LKLJMHNGPFTFVGWHXJXLWNVORQRT RRYQZR[SZRY)",
    R"(E`WNVLTKQKOLNMMPMSNUPVSVUUVS RQKOMNPNSOUPV RWKVSVUXVZV\T]Q]O\L[JYHWGTFQFNGLHJJILHOHRIUJWLYNZQ[T[WZYYZX RXKWSWUXV)",
    R"(I[RFJ[ RRFZ[ RMTWT)", R"(G\KFK[ RKFTFWGXHYJYLXNWOTP RKPTPWQXRYTYWXYWZT[K[)",
    R"(H]ZKYIWGUFQFOGMILKKNKSLVMXOZQ[U[WZYXZV)", R"(G\KFK[ RKFRFUGWIXKYNYSXVWXUZR[K[)",
    R"(H[LFL[ RLFYF RLPTP RL[Y[)", R"(HZLFL[ RLFYF RLPTP)", R"(H]ZKYIWGUFQFOGMILKKNKSLVMXOZQ[U[WZYXZVZS RUSZS)",
    R"(G]KFK[ RYFY[ RKPYP)", R"(NVRFR[)", R"(JZVFVVUYTZR[P[NZMYLVLT)", R"(G\KFK[ RYFKT RPOY[)", R"(HYLFL[ RL[X[)",
    R"(F^JFJ[ RJFR[ RZFR[ RZFZ[)", R"(G]KFK[ RKFY[ RYFY[)", R"(G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF)",
    R"(G\KFK[ RKFTFWGXHYJYMXOWPTQKQ)", R"(G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF RSWY])",
    R"(G\KFK[ RKFTFWGXHYJYLXNWOTPKP RRPY[)", R"(H\YIWGTFPFMGKIKKLMMNOOUQWRXSYUYXWZT[P[MZKX)", R"(JZRFR[ RKFYF)",
    R"(G]KFKULXNZQ[S[VZXXYUYF)", R"(I[JFR[ RZFR[)", R"(F^HFM[ RRFM[ RRFW[ R\FW[)", R"(H\KFY[ RYFK[)",
    R"(I[JFRPR[ RZFRP)", R"(H\YFK[ RKFYF RK[Y[)", R"(KYOBOb RPBPb ROBVB RObVb)", R"(KYKFY^)",
    R"(KYTBTb RUBUb RNBUB RNbUb)", R"(JZRDJR RRDZR)", R"(I[Ib[b)", R"(NVSKQMQORPSORNQO)",
    R"(I\XMX[ RXPVNTMQMONMPLSLUMXOZQ[T[VZXX)", R"(H[LFL[ RLPNNPMSMUNWPXSXUWXUZS[P[NZLX)",
    R"(I[XPVNTMQMONMPLSLUMXOZQ[T[VZXX)", R"(I\XFX[ RXPVNTMQMONMPLSLUMXOZQ[T[VZXX)",
    R"(I[LSXSXQWOVNTMQMONMPLSLUMXOZQ[T[VZXX)", R"(MYWFUFSGRJR[ ROMVM)",
    R"(I\XMX]W`VaTbQbOa RXPVNTMQMONMPLSLUMXOZQ[T[VZXX)", R"(I\MFM[ RMQPNRMUMWNXQX[)", R"(NVQFRGSFREQF RRMR[)",
    R"(MWRFSGTFSERF RSMS^RaPbNb)", R"(IZMFM[ RWMMW RQSX[)", R"(NVRFR[)",
    R"(CaGMG[ RGQJNLMOMQNRQR[ RRQUNWMZM\N]Q][)", R"(I\MMM[ RMQPNRMUMWNXQX[)",
    R"(I\QMONMPLSLUMXOZQ[T[VZXXYUYSXPVNTMQM)", R"(H[LMLb RLPNNPMSMUNWPXSXUWXUZS[P[NZLX)",
    R"(I\XMXb RXPVNTMQMONMPLSLUMXOZQ[T[VZXX)", R"(KXOMO[ ROSPPRNTMWM)", R"(J[XPWNTMQMNNMPNRPSUTWUXWXXWZT[Q[NZMX)",
    R"(MYRFRWSZU[W[ ROMVM)", R"(I\MMMWNZP[S[UZXW RXMX[)", R"(JZLMR[ RXMR[)", R"(G]JMN[ RRMN[ RRMV[ RZMV[)",
    R"(J[MMX[ RXMM[)", R"(JZLMR[ RXMR[P_NaLbKb)", R"(J[XMM[ RMMXM RM[X[)",
    R"(KYTBRCQDPFPHQJRKSMSOQQ RRCQEQGRISJTLTNSPORSTTVTXSZR[Q]Q_Ra RQSSUSWRYQZP\P^Q`RaTb)", R"(NVRBRb)",
    R"(KYPBRCSDTFTHSJRKQMQOSQ RRCSESGRIQJPLPNQPURQTPVPXQZR[S]S_Ra RSSQUQWRYSZT\T^S`RaPb)",
    R"(F^IUISJPLONOPPTSVTXTZS[Q RISJQLPNPPQTTVUXUZT[Q[O)",
    // clang-format on
};

constexpr int capital = '[' - 'F';  // units of a capital letter's height
constexpr int small = '[' - 'M';    // and of a small one's
constexpr double mark_gap = 3.0;

constexpr std::pair<char32_t, std::string_view> further_glyphs[] = {
    {U'–', "H\\KRYR"},
    {U'—', "D`ER_R"},
    {U'−', "E_IR[R"},
    {U'×', "F^LLXX RXLLX"},
    {U'±', "E_RFRV RIN[N RIZ[Z"},
    {U'·', "NVQRRSSRRQQR"},
    {U'•', "MWPRQTSTTRSPQPPR RRRRR"},
    {U'…', "G]JXIWJVKWJX RRXQWRVSWRX RZXYWZV[WZX"},
    {U'°', "LXRFTGUITKRLPKOIPGRF"},
    {U'→', "D`FR^R RYM^RYW"},
    {U'←', "D`FR^R RKMFRKW"},
    {U'≤', "F^ZIJPZW RJ[Z["},
    {U'≥', "F^JIZPJW RJ[Z["},
    {U'‘', "MWSFRGQIQKRLSKRJ"},
    {U'’', "MWRHQGRFSGSIRKQL"},
    {U'“', "JZOFNGMIMKNLOKNJ RWFVGUIUKVLWKVJ"},
    {U'”', "JZNHMGNFOGOINKML RVHUGVFWGWIVKUL"},
    {U'«', "I[QMLTQ[ RXMSTX["},
    {U'»', "I[LMQTL[ RSMXTS["},
    {U'ß', "H\\L[LJMGPFSFVGWIWKVMSOUPWRXUXWWYUZS[P["},
    {U'ø', "I\\QMONMPLSLUMXOZQ[T[VZXXYUYSXPVNTMQM RYLL\\"},
    {U'Ø', "G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF RYDK]"},
    {U'ł', "MWRFR[ ROSUN"},
    {U'Ł', "HYLFL[ RL[X[ RIRRM"},
    {U'đ', "I\\XFX[ RXPVNTMQMONMPLSLUMXOZQ[T[VZXX RTI[I"},
    {U'Đ', "G\\KFK[ RKFRFUGWIXKYNYSXVWXUZR[K[ RHPPP"},
    {U'„', "JZOWNXMWNVOWOYM[ RWWVXUWVVWWWYU["},
    {U'‚', "NVSWRXQWRVSWSYQ["},
    {U'‹', "LXTMOTT["},
    {U'›', "LXPMUTP["},
    {U'€', "F]YIWGUFRFPGNILMLTNXPZR[U[WZYX RHOTO RHRTR"},
    {U'₹', "H\\KFYF RKLYL RKFPFSGUIUNSQPRKRU["},
    {U'£', "H\\XJWHUFRFPGNINLOQOUNXLZK[Y[ RKQTQ"},
    {U'¥', "I[JFRP RZFRPR[ RKRYR RKVYV"},
    {U'©', "E_QFNGKIIKHNHRIUKXNZQ[S[VZYX[U\\R\\N[KYIVGSFQF RVMULSKQKOLNNNROTQUSUUTVS"},
    {U'®', "E_QFNGKIIKHNHRIUKXNZQ[S[VZYX[U\\R\\N[KYIVGSFQF ROUOKSKULUOSPOP RSPUU"},
    {U'™', "E]GFOF RKFKO RQOQFUKYFYO"},
    {U'¡', "MWRQRb RRLQMRNSMRL"},
    {U'¿', "I[X]X^W`VaTbPbNaM`L^L\\MZNYRWRT RROSNRMQNRO"},
    {U'Æ', "D`QFE[ RQFQ[ RITQT RQF_F RQPZP RQ[_["},
    {U'æ', "B^RMR[ RRPPNNMKMINGPFSFUGXIZK[N[PZRX RQS]S]Q\\O[NYMVMTNRPQSQURXTZV[Y[[Z]X"},
    {U'Œ', "A_LFJGHIGKFNFSGVHXJZL[P[RZTXUVVSVNUKTIRGPFLF RNFN[ RNF[F RNPVP RN[[["},
    {U'œ', "B^KMINGPFSFUGXIZK[N[PZRXSUSSRPPNNMKM RRS^S^Q]O\\NZMWMUNSPRSRUSXUZW[Z[\\Z^X"},
    {U'Þ', "G\\KFK[ RKKTKWLXMYOYRXTWUTVKV"},
    {U'þ', "H[LFLb RLPNNPMSMUNWPXSXUWXUZS[P[NZLX"},
    {U'Ð', "G\\KFK[ RKFRFUGWIXKYNYSXVWXUZR[K[ RHPPP"},
    {U'ð', "I\\XSXPVNTMQMONMPLSLUMXOZQ[T[VZXXYUYRXNVJTHQF RPLVF"},
    {U'ħ', "I\\MFM[ RMQPNRMUMWNXQX[ RJISI"},
    {U'′', "NVSFQL"},
    {U'″', "JZPFNL RVFTL"},
    {U'µ', "I\\MMMb RMWNZP[S[UZXW RXMX["},
    {U'÷', "E_IR[R RRJQKRLSKRJ RRXQYRZSYRX"},
    {U'≠', "E_IO[O RIU[U RWJMZ"},
    {U'∞', "C`RRPNNLKLHNGQGSHVKXNXPVRRTNVLYL\\N]Q]S\\VYXVXTVRR"},
    {U'√', "F\\HSKRO[\\D"},
    {U'♥', "F^R[KTHPHLJILHOHQIRLSIUHXHZI\\L\\PYTR["},
    {U'★', "F^RFTN\\NVSXZRVLZNSHNPNRF"},
    {U'ı', "NVRMR["},
};

/// Marks above stand on the line `R`, over the letter; marks below hang from it, at the foot of the letter.
enum class MarkPlace { above, below };
struct Mark {
    char32_t combining;
    MarkPlace place;
    std::string_view glyph;
    std::string_view bases;
    std::u32string_view composed;  ///< composed character of each base
};
constexpr Mark marks[] = {
    {0x300, MarkPlace::above, "SRPN", "AEIOUaeiouNnWwYy", U"ÀÈÌÒÙàèìòùǸǹẀẁỲỳ"},
    {0x301, MarkPlace::above, "QRTN", "AEIOUYCLNRSZaeiouyclnrszGgMmPpWw", U"ÁÉÍÓÚÝĆĹŃŔŚŹáéíóúýćĺńŕśźǴǵḾḿṔṕẂẃ"},
    {0x302, MarkPlace::above, "ORRNUR", "AEIOUaeiouCcGgHhJjSsWwYy", U"ÂÊÎÔÛâêîôûĈĉĜĝĤĥĴĵŜŝŴŵŶŷ"},
    {0x303, MarkPlace::above, "MQOOQOSQUQWO", "AENOaenoIiUuYy", U"ÃẼÑÕãẽñõĨĩŨũỸỹ"},
    {0x304, MarkPlace::above, "NPVP", "AEIOUaeiouYy", U"ĀĒĪŌŪāēīōūȲȳ"},
    {0x306, MarkPlace::above, "NNOPQQSQUPVN", "AEGIOUaegiou", U"ĂĔĞĬŎŬăĕğĭŏŭ"},
    {0x307, MarkPlace::above, "QPRQSPROQP", "CcEeGgIZzNnMmSsRrHhYy", U"ĊċĖėĠġİŻżṄṅṀṁṠṡṘṙḢḣẎẏ"},
    {0x308, MarkPlace::above, "MPNQOPNOMP RUPVQWPVOUP", "AEIOUaeiouyYWw", U"ÄËÏÖÜäëïöüÿŸẄẅ"},
    {0x30A, MarkPlace::above, "RRTQUOTMRLPMOOPQRR", "AaUu", U"ÅåŮů"},
    {0x30B, MarkPlace::above, "ORQN RTRVN", "OUou", U"ŐŰőű"},
    {0x30C, MarkPlace::above, "ONRRUN", "CDENRSTZcdenrstzGg", U"ČĎĚŇŘŠŤŽčďěňřšťžǦǧ"},
    {0x323, MarkPlace::below, "QVRWSVRUQV", "DHKLMNRSTZdhklmnrstzAEIOUaeiou", U"ḌḤḲḶṂṆṚṢṬẒḍḥḳḷṃṇṛṣṭẓẠẸỊỌỤạẹịọụ"},
    {0x326, MarkPlace::below, "RUQX", "STstGKLNRgklnr", U"ȘȚșțĢĶĻŅŖģķļņŗ"},
    {0x327, MarkPlace::below, "RRQTSUTWRYPX", "CSTcst", U"ÇŞŢçşţ"},
    {0x328, MarkPlace::below, "RRPTOVPXRXSW", "AEIUaeiu", U"ĄĘĮŲąęįų"},
    {0x331, MarkPlace::below, "NVVV", "DLNRTZdlnrtz", U"ḎḺṈṞṮẔḏḻṉṟṯẕ"},
};

using Polyline = std::vector<glm::dvec2>;

/// A glyph in font units, y up, from its left border on the baseline.
struct Glyph {
    double width = 0.0;
    std::vector<Polyline> strokes;
    std::vector<LetterStroke> drawn;  ///< strokes with curves of their own
    double low = 0.0, high = 0.0;     ///< extent of the strokes, across
    double top = 0.0;
};

void measure(Glyph& glyph) {
    glyph.low = 1e9;
    glyph.high = -1e9;
    glyph.top = 0.0;
    for (const Polyline& stroke : glyph.strokes) {
        for (const glm::dvec2 point : stroke) {
            glyph.low = std::min(glyph.low, point.x);
            glyph.high = std::max(glyph.high, point.x);
            glyph.top = std::max(glyph.top, point.y);
        }
    }
}

std::vector<Polyline> strokes_of(std::string_view pairs, glm::dvec2 origin) {
    std::vector<Polyline> strokes(1);
    for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
        if (pairs[i] == ' ') {
            strokes.emplace_back();
        } else {
            strokes.back().push_back(origin + glm::dvec2(pairs[i] - 'R', 'R' - pairs[i + 1]));
        }
    }
    std::erase_if(strokes, [](const Polyline& stroke) { return stroke.empty(); });
    return strokes;
}

Glyph glyph_of(std::string_view text) {
    Glyph glyph;
    glyph.width = text[1] - text[0];
    glyph.strokes = strokes_of(text.substr(2), {'R' - text[0], '[' - 'R'});
    measure(glyph);
    return glyph;
}

/// Adds a mark to a glyph. An accent replaces the dot on i and j.
void add_mark(Glyph& glyph, const Mark& mark) {
    const double middle = (glyph.low + glyph.high) / 2;
    const double line = mark.place == MarkPlace::below ? 0.0 : glyph.top + mark_gap;
    for (Polyline& stroke : strokes_of(mark.glyph, {middle, line})) glyph.strokes.push_back(std::move(stroke));
}

void take_dot(Glyph& glyph) {
    std::erase_if(glyph.strokes, [](const Polyline& stroke) {
        return std::all_of(stroke.begin(), stroke.end(), [](glm::dvec2 point) { return point.y > small; });
    });
    measure(glyph);
}

/// Scales and raises a glyph.
Glyph scaled(const Glyph& glyph, double scale, double up) {
    Glyph result = glyph;
    result.width *= scale;
    for (Polyline& stroke : result.strokes) {
        for (glm::dvec2& point : stroke) point = scale * point + glm::dvec2(0.0, up);
    }
    measure(result);
    return result;
}

/// Joins two glyphs.
Glyph joined(Glyph first, const Glyph& second) {
    for (Polyline stroke : second.strokes) {
        for (glm::dvec2& point : stroke) point.x += first.width;
        first.strokes.push_back(std::move(stroke));
    }
    first.width += second.width;
    measure(first);
    return first;
}

/// Adds raised letters and fractions.
void add_small_glyphs(std::map<char32_t, Glyph>& glyphs) {
    constexpr double smaller = 0.6;
    const auto raised = [&](char32_t code) { return scaled(glyphs[code], smaller, (1 - smaller) * capital); };
    constexpr std::array<std::array<char32_t, 2>, 5> raises = {
        {{U'¹', U'1'}, {U'²', U'2'}, {U'³', U'3'}, {U'ª', U'a'}, {U'º', U'o'}}};
    for (const auto& [code, letter] : raises) glyphs[code] = raised(letter);
    constexpr std::array<std::array<char32_t, 3>, 3> fractions = {
        {{U'½', U'1', U'2'}, {U'¼', U'1', U'4'}, {U'¾', U'3', U'4'}}};
    for (const auto& [code, above, below] : fractions) {
        glyphs[code] = joined(joined(raised(above), scaled(glyphs[U'/'], 0.8, 0.1 * capital)),
                              scaled(glyphs[below], smaller, 0.0));
    }
}

/// All glyphs, by code point.
const std::map<char32_t, Glyph>& font() {
    static const std::map<char32_t, Glyph> made = [] {
        std::map<char32_t, Glyph> glyphs;
        for (std::size_t i = 0; i < ascii_glyphs.size(); ++i) {
            glyphs[static_cast<char32_t>(' ' + i)] = glyph_of(ascii_glyphs[i]);
        }
        for (const auto& [code, glyph] : further_glyphs) glyphs[code] = glyph_of(glyph);
        for (const Mark& mark : marks) {
            for (std::size_t i = 0; i < mark.bases.size(); ++i) {
                const char base = mark.bases[i];
                Glyph glyph = glyphs[static_cast<char32_t>(base)];
                if (mark.place == MarkPlace::above && (base == 'i' || base == 'j')) take_dot(glyph);
                add_mark(glyph, mark);
                measure(glyph);
                glyphs[mark.composed[i]] = std::move(glyph);
            }
        }
        add_small_glyphs(glyphs);
        glyphs[U'‐'] = glyphs[U'‑'] = glyphs[U'-'];
        glyphs[U'❤'] = glyphs[U'♥'];
        // Invisible characters have neither ink nor width.
        for (const char32_t invisible : {U'\u00AD', U'\u200B', U'\u200C', U'\u200D', U'\uFE0F', U'\uFEFF'})
            glyphs[invisible] = Glyph{};
        for (const char32_t space : {U'\u00A0', U'\u2009', U'\u202F', U'\t', U'\n', U'\r'})
            glyphs[space] = glyphs[U' '];
        return glyphs;
    }();
    return made;
}

constexpr char32_t first_tamil = 0x0B80, last_tamil = 0x0BFF;

const Glyph& box_glyph() {
    static const Glyph box = glyph_of("I[KFKXYXYFKF");
    return box;
}

const Mark* combining_mark(char32_t code) {
    const auto found =
        std::find_if(std::begin(marks), std::end(marks), [&](const Mark& mark) { return mark.combining == code; });
    return found == std::end(marks) ? nullptr : found;
}

/// The first character and its number of bytes; U+FFFD for an invalid byte.
std::pair<char32_t, std::size_t> first_character(std::string_view text) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return {0xFFFD, 1};
    return {code_point(text.substr(0, length)), length};
}

/// The glyph of the Tamil syllable at the beginning of a text, and its length in bytes; 0 if there is none.
std::size_t take_tamil(std::string_view text, Glyph& glyph) {
    constexpr std::size_t most = 6;  // of the longest syllable
    std::u32string characters;
    std::array<std::size_t, most + 1> ends{};
    while (characters.size() < most && ends[characters.size()] < text.size()) {
        const std::size_t begin = ends[characters.size()];
        const auto [code, bytes] = first_character(text.substr(begin));
        characters += code;
        ends[characters.size()] = begin + bytes;
    }
    auto syllable = tamil_syllable(characters);
    if (!syllable) return 0;
    glyph.width = syllable->width;
    glyph.drawn = std::move(syllable->strokes);
    return ends[syllable->characters];
}

/// Calls `see` with each glyph, marks included, and with the bytes it takes.
template <class See>
void each_glyph(std::string_view text, See&& see) {
    const auto& glyphs = font();
    while (!text.empty()) {
        const auto [code, bytes] = first_character(text);
        std::size_t taken = bytes;
        if (code >= first_tamil && code <= last_tamil) {
            Glyph syllable;
            if (const std::size_t length = take_tamil(text, syllable)) {
                see(syllable, length, true);
                text.remove_prefix(length);
                continue;
            }
        }
        const auto found = glyphs.find(code);
        const Glyph* glyph = found == glyphs.end() ? &box_glyph() : &found->second;
        Glyph marked;
        while (taken < text.size()) {
            const auto [next, next_bytes] = first_character(text.substr(taken));
            const Mark* mark = combining_mark(next);
            if (!mark) break;
            if (glyph != &marked) {
                marked = *glyph;
                glyph = &marked;
                if (mark->place == MarkPlace::above && (code == U'i' || code == U'j')) take_dot(marked);
            }
            add_mark(marked, *mark);
            measure(marked);
            taken += next_bytes;
        }
        see(*glyph, taken, found != glyphs.end());
        text.remove_prefix(taken);
    }
}

/// Direction at a point of a polyline that stands for a curve; 0 0 elsewhere.
glm::dvec2 tangent(glm::dvec2 before, glm::dvec2 at, glm::dvec2 after) {
    constexpr double sharpest = 0.55;  // cosine of the turn that is still a curve
    constexpr double straight = 6.0;   // longer lines are lines, if the next is much shorter
    const double in = glm::distance(before, at), out = glm::distance(at, after);
    if (!(in > 0 && out > 0)) return glm::dvec2(0.0);
    const glm::dvec2 u = (at - before) / in, v = (after - at) / out;
    if (glm::dot(u, v) < sharpest) return glm::dvec2(0.0);
    if (in > straight && in > 2 * out) return u;
    if (out > straight && out > 2 * in) return v;
    // Tangent of the circle through the three points.
    return glm::normalize(u * out + v * in);
}

/// Passes on a stroke with its curves made smooth.
void write_stroke(const Polyline& points, glm::dvec2 start, double scale, const Pen& pen, PathSink& sink) {
    const auto placed = [&](glm::dvec2 point) { return start + scale * point; };
    const std::size_t last = points.size() - 1;
    const bool closed = last > 1 && points.front() == points.back();
    std::vector<glm::dvec2> tangents(points.size(), glm::dvec2(0.0));
    for (std::size_t i = 1; i < last; ++i) tangents[i] = tangent(points[i - 1], points[i], points[i + 1]);
    if (closed) tangents.front() = tangents.back() = tangent(points[last - 1], points[0], points[1]);

    sink.begin_stroke(placed(points.front()), pen);
    if (last == 0) sink.lines(std::array{placed(points.front())});
    for (std::size_t i = 0; i < last; ++i) {
        const glm::dvec2 from = points[i], to = points[i + 1];
        const double length = glm::distance(from, to);
        const glm::dvec2 along = length > 0 ? (to - from) / length : glm::dvec2(0.0);
        glm::dvec2 first = tangents[i], second = tangents[i + 1];
        const auto none = [](glm::dvec2 direction) { return direction == glm::dvec2(0.0); };
        // An end without a direction mirrors the other end: an arc.
        const auto mirrored = [&](glm::dvec2 direction) {
            return 2.0 * glm::dot(direction, along) * along - direction;
        };
        if (none(first) && none(second)) {
            sink.lines(std::array{placed(to)});
            continue;
        }
        if (none(first)) first = mirrored(second);
        if (none(second)) second = mirrored(first);
        sink.curves(std::array{placed(from + first * (length / 3)), placed(to - second * (length / 3)), placed(to)});
    }
    sink.end_stroke(closed);
}

void write_stroke(const LetterStroke& stroke, glm::dvec2 start, double scale, const Pen& pen, PathSink& sink) {
    const auto placed = [&](glm::dvec2 point) { return start + scale * point; };
    sink.begin_stroke(placed(stroke.start), pen);
    for (const LetterStroke::Piece& piece : stroke.pieces) {
        if (piece.is_curve) {
            sink.curves(std::array{placed(piece.first), placed(piece.second), placed(piece.end)});
        } else {
            sink.lines(std::array{placed(piece.end)});
        }
    }
    sink.end_stroke(stroke.is_closed);
}

/// The first character of a text as messages name it.
std::string name_of(std::string_view text) {
    const auto [code, bytes] = first_character(text);
    if (code == 0xFFFD && bytes == 1)
        return fmt::format("the byte {:#04x}", static_cast<unsigned char>(text.front()));
    const bool is_control = code < 0x20 || code == 0x7F || (code >= 0x80 && code < 0xA0);
    const std::string number = fmt::format("U+{:04X}", static_cast<unsigned>(code));
    return is_control ? number : fmt::format("{} ({})", text.substr(0, bytes), number);
}

/// Number of bytes of the longest beginning that is at most `units` wide.
std::size_t fitting(std::string_view text, double units) {
    double width = 0;
    std::size_t bytes = 0;
    bool fits = true;
    each_glyph(text, [&](const Glyph& glyph, std::size_t taken, bool) {
        width += glyph.width;
        // With a margin for rounding, as widths are sums.
        fits = fits && width <= units * (1 + 1e-12);
        if (fits) bytes += taken;
    });
    return bytes;
}

}  // namespace

double text_width(std::string_view utf8, double height) {
    double units = 0;
    each_glyph(utf8, [&](const Glyph& glyph, std::size_t, bool) { units += glyph.width; });
    return units * (height / capital);
}

std::vector<std::string_view> letters_of(std::string_view utf8) {
    std::vector<std::string_view> letters;
    each_glyph(utf8, [&](const Glyph&, std::size_t taken, bool) {
        letters.push_back(utf8.substr(0, taken));
        utf8.remove_prefix(taken);
    });
    return letters;
}

bool has_letters(std::string_view utf8) {
    bool all = true;
    each_glyph(utf8, [&](const Glyph&, std::size_t, bool known) { all = all && known; });
    return all;
}

std::string list_of_characters(const std::vector<std::string_view>& characters) {
    constexpr std::size_t most = 12;
    std::vector<std::string> names;
    for (const std::string_view character : characters) {
        std::string name = name_of(character);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
    }
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) list += (i > 0 ? ", " : "") + names[i];
    if (names.size() > most) list += fmt::format(" and {} more", names.size() - most);
    return list;
}

std::string missing_letters(const std::vector<std::string>& texts) {
    std::vector<std::string_view> missing;
    for (const std::string& whole : texts) {
        std::string_view text = whole;
        each_glyph(text, [&](const Glyph&, std::size_t taken, bool known) {
            if (!known) missing.push_back(text);
            text.remove_prefix(taken);
        });
    }
    return list_of_characters(missing);
}

std::string letters_warning(const std::string& missing) {
    return fmt::format("the lettering font lacks {}; an empty box replaces each", missing);
}

void write_text(std::string_view utf8, glm::dvec2 start, double height, const Pen& pen, PathSink& sink) {
    const double scale = height / capital;
    each_glyph(utf8, [&](const Glyph& glyph, std::size_t, bool) {
        for (const Polyline& stroke : glyph.strokes) write_stroke(stroke, start, scale, pen, sink);
        for (const LetterStroke& stroke : glyph.drawn) write_stroke(stroke, start, scale, pen, sink);
        start.x += scale * glyph.width;
    });
}

std::string shortened(std::string_view utf8, double height, double width) {
    constexpr std::string_view ellipsis = "…";
    const double units = width / (height / capital);
    if (fitting(utf8, units) == utf8.size()) return std::string(utf8);
    const double room = units - text_width(ellipsis, capital);
    if (room < 0) return "";
    return std::string(trimmed(utf8.substr(0, fitting(utf8, room)))).append(ellipsis);
}

std::vector<std::string> wrapped(std::string_view utf8, std::size_t most, const TextCuts& cuts) {
    std::vector<std::string> lines;
    std::string_view rest = trimmed(utf8);
    while (lines.size() + 1 < most) {
        std::size_t end = cuts.fitting(rest);
        if (end == rest.size()) break;
        if (rest[end] != ' ') {
            const std::size_t space = rest.rfind(' ', end);
            const std::size_t hyphen = end == 0 ? std::string_view::npos : rest.rfind('-', end - 1);
            if (space != std::string_view::npos && space > 0)
                end = space;
            else if (hyphen != std::string_view::npos && hyphen > 0)
                end = hyphen + 1;
        }
        // Not even one character fits.
        if (end == 0) break;
        lines.emplace_back(trimmed(rest.substr(0, end)));
        rest = trimmed(rest.substr(end));
    }
    lines.push_back(cuts.shortened(rest));
    return lines;
}

std::vector<std::string> wrapped(std::string_view utf8, double height, double width, std::size_t most) {
    const double units = width / (height / capital);
    return wrapped(utf8, most,
                   {[&](std::string_view text) { return fitting(text, units); },
                    [&](std::string_view text) { return shortened(text, height, width); }});
}

}  // namespace sikku
