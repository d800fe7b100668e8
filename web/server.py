"""Serves dist/ on the loopback interface: server.py PORT. For looking at the page, not for publishing it."""

import http.server
import pathlib
import sys

DIST = pathlib.Path(__file__).resolve().parent.parent / "dist"


class Handler(http.server.SimpleHTTPRequestHandler):
    # The system's own table may say otherwise, and browsers refuse modules of another type.
    extensions_map = {
        **http.server.SimpleHTTPRequestHandler.extensions_map,
        ".css": "text/css",
        ".html": "text/html; charset=utf-8",
        ".js": "text/javascript",
        ".json": "application/json",
        ".png": "image/png",
        ".svg": "image/svg+xml",
        ".wasm": "application/wasm",
        ".webmanifest": "application/manifest+json",
    }

    def __init__(self, *args):
        super().__init__(*args, directory=str(DIST))

    def end_headers(self):
        # The page keeps its name from build to build; browsers ask each time whether it has changed.
        self.send_header("Cache-Control", "no-cache")
        super().end_headers()

    def log_request(self, code="-", size="-"):
        if int(code) >= 400:
            super().log_request(code, size)


def main():
    port = int(sys.argv[1])
    try:
        server = http.server.ThreadingHTTPServer(("127.0.0.1", port), Handler)
    except OSError as error:
        sys.exit(f"Port {port} cannot be used: {error.strerror}. Try another: web/serve.sh --port {port % 65535 + 1}")
    print(f"Tautline is at http://127.0.0.1:{port}/ (Ctrl+C stops it)", flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        pass


main()
