# case-asks.awk: the modules that a case file asks for, read only then: awk -f case-asks.awk CASE
# Exit code: the sum of 1 friction, legs or ties; 2 heat or preload; 4 turns; 8 stresses, lines, yield; 16 a law that is not always read;
# 32 symmetries, or an axis; 64 pressures, tractions, weights; 128 rotations. The last three count in comments and names too.
BEGIN { end = "([ \t\r]|$)" }
$0 ~ "^[ \t]*(leg[ \t]|tie[ \t]|(contact|obstacle)[ \t].*[ \t]friction" end ")" { rubs = 1 }
$0 ~ "^[ \t]*(expand|preload)" end { strained = 1 }
$0 ~ "^[ \t]*rotate" end { turns = 1 }
$0 ~ "^[ \t]*((stresses|line)" end "|body[ \t].*[ \t]yield" end ")" { stressed = 1 }
/[ \t]law[ \t]+(exponential|barrier|table)/ { laws = 1 }
/symmetr/ { mirrored = 1 }
/pressure|traction|weight/ { loaded = 1 }
/rotate/ { rotates = 1 }
END { exit rubs + 2 * strained + 4 * turns + 8 * stressed + 16 * laws + 32 * mirrored + 64 * loaded + 128 * rotates }
