# SPDX-License-Identifier: Apache-2.0
# Makes darkling.yaml(5) of config/default.yaml, which is what `darklingd --print-config` prints: for
# each key a comment that explains it, one that says what is allowed, and the key with its default.

# As roff shows it. Backslashes are put in by character: how often awk reads them in gsub() differs.
function roff(text,    shown, i, c) {
  for (i = 1; i <= length(text); ++i) {
    c = substr(text, i, 1)
    shown = shown (c == "\\" ? "\\e" : c == "-" ? "\\-" : c == "\"" ? "\\(dq" : c)
  }
  return shown
}

# A sentence in lines of at most 78 characters, none of which roff takes for a request.
function print_text(text,    count, words, i, line) {
  count = split(roff(text), words, " ")
  for (i = 1; i <= count; ++i) {
    if (line != "" && length(line) + length(words[i]) > 77) {
      print line
      line = ""
    }
    if (line == "" && words[i] ~ /^[.']/) line = "\\&"
    line = line (line == "" || line == "\\&" ? "" : " ") words[i]
  }
  print line
}

BEGIN {
  print ".\\\" SPDX-License-Identifier: Apache-2.0"
  print ".TH DARKLING.YAML 5 2026-11-26 Darkling \"Darkling Manual\""
  print ".SH NAME"
  print "darkling.yaml \\- configuration of darklingd and darkling"
  print ".SH DESCRIPTION"
  print "A flat YAML map of"
  print ".IR key : \" value\""
  print "lines, read by"
  print ".BR darklingd (8)"
  print "and by the verbs of"
  print ".BR darkling (1)"
  print "that take"
  print ".BR \\-\\-config ."
  print "A key that is left out has its default;"
  print ".B \\-\\-set"
  print ".I key=value"
  print "goes before the file."
  print "A key that is not known, comes twice or has a value that is not allowed is"
  print "refused with file, line and what is allowed."
  print ".PP"
  print ".B darklingd \\-\\-print\\-config"
  print "prints such a file with what is in force."
  print ".SH KEYS"
  print "With their defaults:"
}

/^# Allowed: / { allowed = substr($0, 3); next }
/^# / { about = substr($0, 3); next }
/^[a-z0-9_]+:/ {
  colon = index($0, ":")
  value = substr($0, colon + 2)
  print ".TP"
  print ".B " substr($0, 1, colon) " \\fI" roff(value) "\\fR"
  print_text(about)
  print_text(allowed)
}

END {
  print ".SH FILES"
  print ".TP"
  print ".I /etc/darkling/darkling.yaml"
  print "What the unit starts"
  print ".BR darklingd (8)"
  print "with."
  print ".TP"
  print ".I share/darkling/darkling.yaml.example"
  print "Every key with its default, to begin with."
  print ".SH SEE ALSO"
  print ".BR darkling (1),"
  print ".BR darklingd (8)"
}
