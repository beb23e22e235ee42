"""Tables in Markdown, as the README holds them, printed row by row while they are measured."""


class Table:
    def __init__(self, *heads, words=1):
        """The first `words` columns hold words, the others numbers."""
        self.heads = heads
        self._print(heads)
        print("|" + "|".join("---" if k < words else "---:" for k in range(len(heads))) + "|", flush=True)

    def row(self, *cells):
        assert len(cells) == len(self.heads), (cells, self.heads)
        self._print(cells)

    @staticmethod
    def _print(cells):
        print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def percent(part):
    return f"{100 * part:.1f}" if part < 0.0995 else f"{100 * part:.0f}"


def seconds(value):
    return f"{value:.2f}" if value < 10 else f"{value:.1f}"


def count(value):
    """With spaces between thousands."""
    return f"{value:,}".replace(",", " ")
