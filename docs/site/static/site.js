// Setting the formulas makes a page longer: a link to a place in it is followed again once they are set.
window.addEventListener("load", () => {
  const set = window.MathJax && window.MathJax.startup && window.MathJax.startup.promise;
  const place = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!set || !place) return;
  let moved = false;
  for (const kind of ["wheel", "touchmove", "keydown", "mousedown"]) {
    window.addEventListener(kind, () => { moved = true; }, { once: true, passive: true });
  }
  const follow = () => { if (!moved) place.scrollIntoView({ behavior: "instant" }); };
  set.then(follow).then(() => document.fonts.ready).then(() => requestAnimationFrame(follow));
});
