// formulas.js - KaTeX over every formula that the page holds; each stands in an element of class "arithmatex".
document.addEventListener("DOMContentLoaded", function () {
    document.querySelectorAll(".arithmatex").forEach(function (element) {
        renderMathInElement(element, {
            delimiters: [
                {left: "\\(", right: "\\)", display: false},
                {left: "\\[", right: "\\]", display: true},
            ],
            throwOnError: false,
        });
    });
});
