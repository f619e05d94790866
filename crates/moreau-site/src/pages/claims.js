// Search and filters of the list of claims. The list itself is in the page; this hides what is not asked for, and keeps the choice in the address.
(function () {
  "use strict";
  var AXES = ["section", "verdict", "severity", "kind", "evidence"];
  var form = document.getElementById("filters");
  var shown = document.getElementById("shown");
  // as a keyboard types it: without accents, with its plain dash and quotes
  var plain = function (text) {
    return text.normalize("NFKD").replace(/\p{M}/gu, "").replace(/[\u2010-\u2015\u2212]/g, "-").replace(/[‘’]/g, "'").replace(/[“”]/g, '"').toLowerCase();
  };
  var claims = Array.prototype.map.call(document.getElementById("claims").children, function (item) {
    var texts = [item.querySelector("a")].concat(Array.prototype.slice.call(item.querySelectorAll("[data-text]")));
    return { item: item, text: plain(texts.map(function (one) { return one.textContent; }).join(" ")) };
  });

  function apply() {
    var words = plain(form.elements.q.value).split(/\s+/).filter(Boolean);
    var count = 0;
    claims.forEach(function (claim) {
      var chosen = AXES.every(function (axis) {
        var wanted = form.elements[axis].value;
        return !wanted || claim.item.dataset[axis] === wanted;
      });
      var found = chosen && words.every(function (word) { return claim.text.indexOf(word) >= 0; });
      claim.item.hidden = !found;
      count += found ? 1 : 0;
    });
    shown.textContent = String(count);
  }

  function keep() {
    var parts = new URLSearchParams();
    ["q"].concat(AXES).forEach(function (name) {
      var value = form.elements[name].value.trim();
      if (value) { parts.set(name, value); }
    });
    history.replaceState(null, "", "#" + parts.toString());
    twin();
  }

  // the page in the other language opens with the same choice
  function twin() {
    var link = document.querySelector("a.language");
    link.href = link.getAttribute("href").split("#")[0] + location.hash;
  }

  function restore() {
    var parts = new URLSearchParams(location.hash.slice(1));
    ["q"].concat(AXES).forEach(function (name) {
      form.elements[name].value = parts.get(name) || "";
      // a value that no option has chooses none
      if (form.elements[name].selectedIndex === -1) { form.elements[name].value = ""; }
    });
    apply();
    twin();
  }

  form.addEventListener("input", function () { apply(); keep(); });
  form.addEventListener("reset", function () { setTimeout(function () { apply(); keep(); }, 0); });
  form.addEventListener("submit", function (event) { event.preventDefault(); });
  window.addEventListener("hashchange", restore);
  restore();
})();
