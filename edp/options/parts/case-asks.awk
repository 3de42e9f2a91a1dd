# case-asks.awk: the modules that a case file asks for, read only then: awk -f case-asks.awk CASE
# Exit code: the sum of 1 friction, legs, ties, plastic; 2 heat, conducted or not, or preload; 4 turns; 8 stresses, lines, yield, plastic,
# expansion by conducted heat; 16 a law that is not always read; 32 symmetries, or an axis; 64 pressures, tractions, weights, gravity; 128
# rotations. The last three count in comments and names too.
# With -v more=1: the sum of 1 free and rigid forces, moments, spins, springs; 2 moments to be told; 4 wear; 8 conducted heat; 16 plastic.
BEGIN { end = "([ \t\r]|$)" }
$0 ~ "^[ \t]*((leg|tie)" end "|(contact|obstacle|join)[ \t].*[ \t]friction" end "|join[ \t].*[ \t]tie" end ")" { rubs = 1 }
$0 ~ "^[ \t]*(expand|preload|conduct)" end { strained = 1 }
$0 ~ "^[ \t]*conduct" end { heated = 1 }
$0 ~ "^[ \t]*rotate" end { turns = 1 }
$0 ~ "^[ \t]*((stresses|line)" end "|body[ \t].*[ \t]yield" end "|conduct[ \t].*[ \t]expand" end ")" { stressed = 1 }
$0 ~ "^[ \t]*plastic[ \t]" { rubs = stressed = flows = 1 }
/[ \t]law[ \t]+(exponential|barrier|table)/ { laws = 1 }
/symmetr/ { mirrored = 1 }
/pressure|traction|weight|gravity/ { loaded = 1 }
/rotate/ { rotates = 1 }
$0 ~ "^[ \t]*((moment|spin|spring)[ \t]|force[ \t].*[ \t](free|rigid)" end ")" { pushed = 1 }
$0 ~ "^[ \t]*(about|moment|rotate)[ \t]" { told = 1 }
$0 ~ "^[ \t]*((contact|obstacle|join)[ \t].*[ \t]wear|cycles)" end { worn = 1 }
END { if (more) exit pushed + 2 * (told || rubs) + 4 * worn + 8 * heated + 16 * flows }
END { exit rubs + 2 * strained + 4 * turns + 8 * stressed + 16 * laws + 32 * mirrored + 64 * loaded + 128 * rotates }
