"""What all commands end with: they print and write one report."""
from reports import document, page
from reports.files import write_file


def deliver(report, options, csv_columns=None, page_of=page.page_of):
    """As the options ask: the page, which page_of(report) makes, the CSV, and on standard output JSON, Markdown or text."""
    if csv_columns is not None and options.csv:
        write_file(options.csv, document.csv(csv_columns))
    if getattr(options, "html", None):
        write_file(options.html, page_of(report))
    if options.json:
        print(document.json(report), end="")
    elif getattr(options, "markdown", False):
        print(document.markdown(report), end="")
    elif not options.quiet:
        print(document.text(report), end="")
