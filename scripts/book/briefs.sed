# A brief description ends at a full stop before a blank: not at that of an abbreviation.
s/\b(Eqs?|Figs?|Sect?|Thm|cf|vs)\. /\1.\\ /g
