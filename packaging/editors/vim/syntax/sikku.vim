" Vim syntax file. Language: Sikku patterns (*.lsys). Made by `sikku lsp --grammar vim`.
if exists("b:current_syntax")
  finish
endif
syn case match
syn sync minlines=200

" Words
syn match sikkuSymbol /@\=[^ \t()<>:*]/ contained
syn match sikkuPen /\%(!\|#\|'\|,\|;\)/ contained
syn match sikkuTurn /\%(\$\|&\|+\|-\|\/\|\\\|\^\||\)/ contained
syn match sikkuBranch /\%(%\|\[\|\]\|{\|}\)/ contained
syn match sikkuDraw /\%(@\.\|@O\|F\|f\)/ contained
syn match sikkuDraw /\~\a\w*/ contained
syn match sikkuContext /[<>]/ contained
syn match sikkuEmpty /\*\|ε/ contained
syn match sikkuArrow /-->/ contained
syn match sikkuContinuation /\s\zs\\$/ contained
" Expressions
syn match sikkuName /\%(\a\|_\|[^\x00-\x7f]\)\%(\w\|[^\x00-\x7f]\)*/ contained
syn match sikkuFunction /\<\%(random\|atan2\|floor\|log10\|round\|acos\|asin\|atan\|ceil\|sqrt\|abs\|cos\|exp\|log\|max\|min\|mod\|sin\|tan\)\ze\s*(/ contained
syn match sikkuNumber /\%(\d\+\.\=\d*\|\.\d\+\)\%([eE][+-]\=\d\+\)\=/ contained
syn region sikkuParameters start=/(/ end=/)/ contained oneline contains=sikkuParameters,sikkuName,sikkuFunction,sikkuNumber,sikkuComment,sikkuContinuation
syn region sikkuExpression start=/:/ end=/\ze-->/ skip=/\s\\$/ end=/$/ contained contains=sikkuParameters,sikkuName,sikkuFunction,sikkuNumber,sikkuComment,sikkuContinuation
" Values
syn match sikkuChoice /\c\<\%(melodic-minor-fifth-mode\|prometheus-supercollider\|ptolemy-intense-diatonic\|raga-bhairavi-hindustani\|Acoustic\s\+Guitar\s\+(nylon)\|Acoustic\s\+Guitar\s\+(steel)\|Electric\s\+Guitar\s\+(clean)\|Electric\s\+Guitar\s\+(muted)\|melodic-minor-ascending\|Electric\s\+Bass\s\+(finger)\|Electric\s\+Guitar\s\+(jazz)\|double-harmonic-lydian\|quarter-comma-meantone\|raga-bhairavi-carnatic\|Bright\s\+Acoustic\s\+Piano\|diminished-whole-tone\|double-harmonic-major\|double-harmonic-minor\|flat-three-pentatonic\|half-whole-diminished\|mixolydian-pentatonic\|pythagorean-chromatic\|whole-half-diminished\|Acoustic\s\+Grand\s\+Piano\|Electric\s\+Bass\s\+(pick)\|Electric\s\+Grand\s\+Piano\|bohlen-pierce-lambda\|maqam-kijaz-kar-kurd\|octatonic-half-whole\|octatonic-whole-half\|progression\s\+I-IV-V-I\|pythagorean-diatonic\|suspended-pentatonic\|bohlen-pierce-equal\|dominant-diminished\|hindustani-bhairavi\|maqam-nahawand-desc\|quarter-comma-major\|bohlen-pierce-just\|hindustani-asavari\|leading-whole-tone\|maqam-ushaq-mashri\|meantone-chromatic\|melodic-minor-desc\|messiaen's\s\+mode\s\+#1\|messiaen's\s\+mode\s\+#2\|messiaen's\s\+mode\s\+#3\|messiaen's\s\+mode\s\+#4\|messiaen's\s\+mode\s\+#5\|messiaen's\s\+mode\s\+#6\|messiaen's\s\+mode\s\+#7\|raga-mohanakalyani\|raga-suddha-saveri\|six-tone-symmetric\|19-equal-diatonic\|31-equal-diatonic\|53-equal-diatonic\|Distortion\s\+Guitar\|Guitar\s\+Fret\s\+Noise\|Overdriven\s\+Guitar\|Pizzicato\s\+Strings\|carnatic-bhairavi\|indian-pentatonic\|lydian-pentatonic\|melodic-minor-asc\|phrygian-dominant\|progression\s\+blues\|pythagorean-major\|raga-madhyamavati\|spline\s\+with\s\+lifts\|Guitar\s\+Harmonics\|Honky-tonk\s\+Piano\|Percussive\s\+Organ\|lydian-augmented\|major-pentatonic\|maqam-athar-kurd\|maqam-bastanikar\|maqam-hijaz-desc\|maqam-nawa-athar\|maqam-shawq-afza\|maqam-sikah-desc\|maqam-yakah-desc\|minor-pentatonic\|neapolitan-major\|neapolitan-minor\|raga-hamsadhwani\|raga-sivaranjani\|shankarabharanam\|ukrainian-dorian\|Orchestral\s\+Harp\|Tango\s\+Accordion\|Tremolo\s\+Strings\|double-harmonic\|harmonic-series\|hindustani-todi\|hungarian-major\|hungarian-minor\|lydian-dominant\|maqam-farahfaza\|maqam-hijaz-kar\|maqam-karjighar\|maqam-rast-desc\|overtone-series\|raga-sriranjani\|scriabin-mystic\|Reverse\s\+Cymbal\|Telephone\s\+Ring\|bebop-dominant\|harmonic-major\|harmonic-minor\|maqam-husseini\|maqam-jiharkah\|maqam-murassah\|maqam-nahawand\|maqam-zanjaran\|meantone-major\|phrygian-major\|romanian-minor\|5-limit-major\|5-limit-minor\|Acoustic\s\+Bass\|Brass\s\+Section\|Drawbar\s\+Organ\|Fretless\s\+Bass\|Muted\s\+Trumpet\|Orchestra\s\+Hit\|Tubular\s\+Bells\|anticlockwise\|arpeggio\s\+down\|bhairavi-that\|bohlen-pierce\|by\s\+neighbours\|carnatic-todi\|leading-whole\|locrian-major\|lowest\s\+vertex\|melodic-major\|melodic-minor\|mixolydian\s\+b6\|natural-minor\|quarter-tones\|raga-bilahari\|raga-hindolam\|raga-kambhoji\|raga-malahari\|shanmugapriya\|slendro-equal\|super-locrian\|19-edo-major\|19-edo-minor\|31-edo-major\|31-edo-minor\|53-edo-major\|Baritone\s\+Sax\|Blown\s\+Bottle\|Breath\s\+Noise\|Church\s\+Organ\|English\s\+Horn\|Glockenspiel\|ahir-bhairav\|asavari-that\|asawari-that\|bhairav-that\|bilaval-that\|by\s\+direction\|carlos-alpha\|carlos-gamma\|counterpoint\|diminished-2\|lydian-minor\|maqam-bayati\|maqam-mustar\|maqam-nairuz\|maqam-nikriz\|maqam-suznak\|maqam-zamzam\|pelog-approx\|raga-asavari\|raga-asawari\|raga-mohanam\|slendro-like\|vietnamese-2\|walking\s\+bass\|French\s\+Horn\|Harpsichord\|Melodic\s\+Tom\|Soprano\s\+Sax\|Steel\s\+Drums\|Synth\s\+Voice\|Tinkle\s\+Bell\|augmented-2\|bebop-major\|blues-major\|blues-minor\|by\s\+distance\|by\s\+symmetry\|carlos-beta\|chalanattai\|gamanasrama\|kalyan-that\|khamaj-that\|lowest\s\+note\|major-blues\|malkos-raga\|maqam-hijaz\|maqam-huzam\|maqam-mahur\|maqam-sikah\|maqam-yakah\|minor-blues\|misra\s\+chapu\|octave\s\+down\|pantuvarali\|pythagorean\|raga-abheri\|raga-abhogi\|raga-arabhi\|raga-revati\|raga-saveri\|Bird\s\+Tweet\|Choir\s\+Aahs\|Contrabass\|Helicopter\|Reed\s\+Organ\|Rock\s\+Organ\|Shakuhachi\|Synth\s\+Drum\|Taiko\s\+Drum\|Vibraphone\|Voice\s\+Oohs\|chessboard\|first\s\+note\|jazz-minor\|just-major\|just-minor\|kumoijoshi\|maqam-ajam\|maqam-iraq\|maqam-kurd\|maqam-rast\|maqam-saba\|marva-that\|messiaen-1\|messiaen-2\|mixolydian\|pentatonic\|prometheus\|purvi-that\|raga-marva\|raga-marwa\|ritardando\|thai-equal\|whole-tone\|Accordion\|Harmonica\|Music\s\+Box\|Pan\s\+Flute\|Tenor\s\+Sax\|Woodblock\|Xylophone\|alternate\|augmented\|bp-lambda\|by\s\+centre\|by\s\+length\|by\s\+strand\|byzantine\|chromatic\|clockwise\|dorian\s\+#4\|each\s\+step\|enigmatic\|framework\|glissando\|hirajoshi\|kafi-that\|lydian\s\+b7\|marigolds\|meend\s\+all\|octave\s\+up\|red-earth\|todi-raga\|todi-that\|Alto\s\+Sax\|Applause\|Clarinet\|Clavinet\|Dulcimer\|Recorder\|Seashore\|Shamisen\|Trombone\|acoustic\|arpeggio\|balinese\|by\s\+depth\|by\s\+level\|by\s\+shape\|by\s\+worms\|concrete\|cow-dung\|detached\|diamonds\|diatonic\|distinct\|dominant\|egyptian\|festival\|freygish\|kambodhi\|maj-pent\|malkauns\|man-gong\|marigold\|meantone\|min-pent\|overtone\|phrygian\|pressure\|scriabin\|sequence\|straight\|5-equal\|Allegro\|Bagpipe\|Bassoon\|Celesta\|Gunshot\|Kalimba\|Marimba\|Ocarina\|Piccolo\|Timpani\|Trumpet\|Whistle\|aeolian\|alberti\|altered\|bhairav\|bhupali\|bp-just\|by\s\+hand\|by\s\+kind\|by\s\+turn\|chinese\|fermata\|gravity\|kalyani\|locrian\|monsoon\|nothing\|oom-pah\|outline\|peacock\|persian\|polygon\|project\|reflect\|ritusen\|spanish\|splines\|strands\|symbols\|truchet\|19-edo\|19-tet\|Fiddle\|Shanai\|Violin\|bartok\|border\|centre\|circle\|common\|dorian\|extend\|ignore\|in-sen\|indian\|ionian\|legato\|louder\|lydian\|malkos\|merged\|mystic\|pongal\|refuse\|shadow\|shares\|shruti\|silent\|softer\|spline\|strict\|temple\|triads\|voices\|5-edo\|7-edo\|Agogo\|Banjo\|Cello\|Flute\|Sitar\|Viola\|bebop\|blank\|block\|blues\|bossa\|clamp\|curve\|drone\|fixed\|front\|hindu\|insen\|iwato\|kaavi\|kolam\|kumai\|kumoi\|lamps\|lotus\|major\|minor\|pelog\|piece\|purvi\|right\|shang\|sides\|slate\|sruti\|strum\|tonic\|voice\|walls\|waves\|white\|whole\|worms\|AABA\|Koto\|Oboe\|Tuba\|bass\|both\|by\s\+x\|by\s\+y\|dots\|each\|even\|fill\|flat\|fold\|free\|gong\|jiao\|left\|none\|once\|padi\|rest\|rope\|runs\|side\|skip\|adi\|age\|all\|bar\|sky\|sun\|top\|yes\|zhi\|Bb\|bp\|no\|yu\|p\)\%(\w\|-\)\@!/ contained
syn match sikkuColour /\c\<\%(lightgoldenrodyellow\|mediumspringgreen\|mediumaquamarine\|mediumslateblue\|mediumturquoise\|mediumvioletred\|blanchedalmond\|cornflowerblue\|darkolivegreen\|lightslategray\|lightslategrey\|lightsteelblue\|mediumseagreen\|darkgoldenrod\|darkslateblue\|darkslategray\|darkslategrey\|darkturquoise\|lavenderblush\|lightseagreen\|palegoldenrod\|paleturquoise\|palevioletred\|rebeccapurple\|antiquewhite\|darkseagreen\|lemonchiffon\|lightskyblue\|mediumorchid\|mediumpurple\|midnightblue\|darkmagenta\|deepskyblue\|floralwhite\|forestgreen\|greenyellow\|lightsalmon\|lightyellow\|navajowhite\|saddlebrown\|springgreen\|transparent\|yellowgreen\|aquamarine\|blueviolet\|chartreuse\|darkorange\|darkorchid\|darksalmon\|darkviolet\|dodgerblue\|ghostwhite\|lightcoral\|lightgreen\|mediumblue\|papayawhip\|powderblue\|sandybrown\|whitesmoke\|aliceblue\|burlywood\|cadetblue\|chocolate\|darkgreen\|darkkhaki\|firebrick\|gainsboro\|goldenrod\|indianred\|lawngreen\|lightblue\|lightcyan\|lightgray\|lightgrey\|lightpink\|limegreen\|mintcream\|mistyrose\|olivedrab\|orangered\|palegreen\|peachpuff\|rosybrown\|royalblue\|slateblue\|slategray\|slategrey\|steelblue\|turquoise\|cornsilk\|darkblue\|darkcyan\|darkgray\|darkgrey\|deeppink\|honeydew\|lavender\|moccasin\|seagreen\|seashell\|crimson\|darkred\|dimgray\|dimgrey\|fuchsia\|hotpink\|magenta\|oldlace\|skyblue\|thistle\|bisque\|indigo\|maroon\|orange\|orchid\|purple\|salmon\|sienna\|silver\|tomato\|violet\|yellow\|azure\|beige\|black\|brown\|coral\|green\|ivory\|khaki\|linen\|olive\|wheat\|white\|aqua\|blue\|cyan\|gold\|gray\|grey\|lime\|navy\|peru\|pink\|plum\|snow\|teal\|red\|tan\)\>/ contained
syn match sikkuColour /#\%(\x\{8}\|\x\{6}\|\x\{3,4}\)\>/ contained
syn match sikkuSectionName /[^ \t*(),=:]\+\ze\s*\%(=\|[*(]\|\s\|$\)/ contained
syn match sikkuFactor /\*\s*\%(\d\+\|\a\w*\)\=/ contained contains=sikkuNumber,sikkuName
syn cluster sikkuWords contains=sikkuSymbol,sikkuPen,sikkuTurn,sikkuBranch,sikkuDraw,sikkuParameters,sikkuComment,sikkuContinuation
" Lines
syn match sikkuKey /^\s*\c\%(derivation\s\+length\|angle\s\+increment\|accompaniment\|transposition\|angle\s\+factor\|articulation\|augmentation\|counterpoint\|ground\s\+plane\|scale\s\+factor\|tile\s\+colours\|named\s\+notes\|controller\|elasticity\|instrument\|retrograde\|tile\s\+edges\|wall\s\+width\|inversion\|lettering\|brackets\|decorate\|keyboard\|parallel\|polygons\|thinning\|velocity\|vertical\|cadence\|excerpt\|harmony\|heading\|mapping\|outline\|palette\|phrases\|powders\|stretch\|tension\|tropism\|anchor\|border\|breath\|climax\|divide\|ending\|fields\|gamaka\|ground\|growth\|rhythm\|sloped\|stroke\|tissue\|upbeat\|canon\|cells\|inset\|leaps\|light\|meter\|paper\|place\|range\|scale\|speed\|start\|swing\|tempo\|tonic\|weave\|dots\|fill\|form\|hand\|line\|loop\|runs\|seed\|sway\|turn\|unit\|view\|map\|pan\)\ze\s*:/ nextgroup=sikkuValue skipwhite
syn region sikkuValue matchgroup=sikkuColon start=/:/ skip=/\s\\$/ end=/$/ contained contains=sikkuChoice,sikkuColour,sikkuNumber,sikkuComment,sikkuContinuation
syn match sikkuKey /^\s*\c\%(schedule\)\ze\s*:/ nextgroup=sikkuSchedule skipwhite
syn region sikkuSchedule matchgroup=sikkuColon start=/:/ skip=/\s\\$/ end=/$/ contained contains=sikkuParameters,sikkuSectionName,sikkuFactor,sikkuComment,sikkuContinuation
syn match sikkuKey /^\s*\c\%(surface\)\ze\s*:/ nextgroup=sikkuSurfaces skipwhite
syn region sikkuSurfaces matchgroup=sikkuColon start=/:/ skip=/\s\\$/ end=/$/ contained contains=sikkuSectionName,sikkuComment,sikkuContinuation
syn match sikkuKey /^\s*\c\%(consider\|forward\|symbols\|ignore\|mirror\|axiom\|edges\|move\)\ze\s*:/ nextgroup=sikkuWord skipwhite
syn region sikkuWord matchgroup=sikkuColon start=/:/ skip=/\s\\$/ end=/$/ contained contains=@sikkuWords
syn match sikkuKey /^\s*\c\%(change\|chord\|label\|drum\|note\|rest\)\ze\s\+\S\+\s*:/ nextgroup=sikkuSymbolValueOf skipwhite
syn match sikkuSymbolValueOf /\S\{-1,}\ze\s*:/ contained nextgroup=sikkuSymbolValue skipwhite
syn region sikkuSymbolValue matchgroup=sikkuColon start=/:/ skip=/\s\\$/ end=/$/ contained contains=sikkuChoice,sikkuColour,sikkuNumber,sikkuComment,sikkuContinuation
syn match sikkuKey /^\s*\c\%(edge\)\ze\s\+\S\+\s*:/ nextgroup=sikkuSymbolWordOf skipwhite
syn match sikkuSymbolWordOf /\S\{-1,}\ze\s*:/ contained nextgroup=sikkuSymbolWord skipwhite
syn region sikkuSymbolWord matchgroup=sikkuColon start=/:/ skip=/\s\\$/ end=/$/ contained contains=@sikkuWords
syn match sikkuSection /^\s*\cinterpret\ze\s*:/ nextgroup=sikkuColon skipwhite
syn match sikkuColon /:/ contained
syn match sikkuSection /^\s*\c\%(table\|patch\)\ze\s[^:]*:/ nextgroup=sikkuTable skipwhite
syn match sikkuTable /[^:]*[^: \t]/ contained nextgroup=sikkuColon skipwhite
syn match sikkuSection /^\s*\cvariant\ze\s[^:]*:/ nextgroup=sikkuVariant skipwhite
syn match sikkuVariant /[^:]*[^: \t]/ contained nextgroup=sikkuSettings skipwhite
syn region sikkuSettings matchgroup=sikkuColon start=/:/ skip=/\s\\$/ end=/$/ contained contains=sikkuSetting,sikkuChoice,sikkuColour,sikkuNumber,sikkuComment,sikkuContinuation
syn match sikkuSetting /\%([:,]\s*\)\@<=[^ \t=,:][^=,:]\{-}\ze\s*=/ contained
syn match sikkuDefine /^\s*#\=define\ze\s/ nextgroup=sikkuConstant skipwhite
syn match sikkuConstant /[^ \t=]\+/ contained nextgroup=sikkuDefined skipwhite
syn region sikkuDefined start=/\S/ skip=/\s\\$/ end=/$/ contained contains=sikkuParameters,sikkuName,sikkuFunction,sikkuNumber,sikkuComment,sikkuContinuation
syn match sikkuRow /^\s*[-+.0-9][-+.0-9eE \t]*$/
syn region sikkuProduction start=/^\ze\%([^()]\|(\%([^()]\|([^()]*)\)*)\)\{-}-->/ skip=/\s\\$/ end=/$/ contains=@sikkuWords,sikkuArrow,sikkuContext,sikkuEmpty,sikkuExpression
syn match sikkuKey /^\s*\c\%(description\|composer\|source\|title\)\ze\s*:/ nextgroup=sikkuText skipwhite
syn region sikkuText matchgroup=sikkuColon start=/:/ skip=/\s\\$/ end=/$/ contained contains=sikkuComment,sikkuContinuation
syn match sikkuComment /^\s*\/\/.*/
syn region sikkuComment start=/\/\*/ end=/\*\//

hi def link sikkuComment Comment
hi def link sikkuKey Identifier
hi def link sikkuColon Delimiter
hi def link sikkuSection Statement
hi def link sikkuSectionName Title
hi def link sikkuTable Title
hi def link sikkuVariant Title
hi def link sikkuSetting Identifier
hi def link sikkuDefine Define
hi def link sikkuConstant Constant
hi def link sikkuArrow Operator
hi def link sikkuContext Operator
hi def link sikkuEmpty Constant
hi def link sikkuContinuation Special
hi def link sikkuText String
hi def link sikkuValue String
hi def link sikkuSettings String
hi def link sikkuSurfaces String
hi def link sikkuSymbolValue String
hi def link sikkuSymbolValueOf Type
hi def link sikkuSymbolWordOf Type
hi def link sikkuSymbol Type
hi def link sikkuDraw Function
hi def link sikkuTurn Operator
hi def link sikkuBranch Delimiter
hi def link sikkuPen Special
hi def link sikkuName Identifier
hi def link sikkuFunction Function
hi def link sikkuNumber Number
hi def link sikkuRow Number
hi def link sikkuFactor Operator
hi def link sikkuParameters Delimiter
hi def link sikkuExpression Operator
hi def link sikkuDefined Operator
hi def link sikkuChoice Constant
hi def link sikkuColour Constant
hi def link sikkuSchedule Delimiter

let b:current_syntax = "sikku"
