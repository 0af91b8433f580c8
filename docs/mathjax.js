MathJax.Hub.Config({
  messageStyle: "none",      // no progress box in the corner
  showMathMenu: false,       // the menu and its zoom are not shipped with the book
  SVG: { blacker: 0, scale: 91, minScaleAdjust: 80, },
  TeX: { noErrors: { disabled: true } },
});
// MathML for screen readers; it needs a page that has formulas.
MathJax.Hub.Register.StartupHook("mml Jax Ready", function () {
  return MathJax.Ajax.Require("[MathJax]/extensions/AssistiveMML.js");
});
