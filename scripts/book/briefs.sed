# A brief description ends at a full stop before a blank: not at that of an abbreviation, of an initial, or of anything in brackets. The
# whole file is one text (sed -z), for a reference goes over lines; what follows such a stop at the end of a line moves up to it.
s/\b(Eqs?|Figs?|Sect?|Thm|cf|vs)\. /\1.\\ /g
:initials
s/((^|[(,;]|\/\/\/<?|\b(and|of|by|in|after)|[A-Z]\.\\) ?[A-Z])\. ([A-Z])/\1.\\ \4/
t initials
s/((^|[(,;]|\/\/\/<?|\b(and|of|by|in|after)|[A-Z]\.\\) ?[A-Z])\.\n( *\/\/\/<?) ([A-Z]([^ \n\\]|\\ )*)/\1.\\ \5\n\4/
t initials
:brackets
s/(\/\/\/[^\n]*\([^()]*[A-Za-z])\. /\1.\\ /
t brackets
s/(\/\/\/[^\n]*\([^()]*[A-Za-z])\.\n( *\/\/\/<?) (([^ \n\\]|\\ )+)/\1.\\ \3\n\2/
t brackets
