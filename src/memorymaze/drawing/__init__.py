"""A site's plan drawn: its shapes, and back ends that put them on paper, page or terminal."""
