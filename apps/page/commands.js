// ---- What each command adds to its page

const commands = {};

/// Painted back to front.
commands.order = () => ({
  beginsAtEye: true,
  nameOf: k => `polygon ${polygons.number(k) + 1} of ${polygons.of} from the back`,
  begin() {
    drawing.painter = true;
    const last = element('p', {id: 'painted'});
    const show = n => {
      drawing.to = n;
      last.textContent = n > 0 ? `painted last: face ${polygons.faces[n - 1]}` : 'nothing is painted yet';
      setLines('last', n > 0 && n < polygons.count ? outlinesOf([n - 1], inkColour(), 1.5) : [], true);
      redraw();
    };
    section('Back to front', player('how many polygons are painted', 0, polygons.count, polygons.count, show), last,
      element('p', {className: 'faint'}, 'From the eye each polygon is painted over those before it, without a depth buffer. From elsewhere the order is another one, and a depth buffer decides.'));
  },
});
